// Speed of FBX and glTF on a single thread: a minute of 31 joints at 120 Hz with a key in each
// frame, in files written by Kinemend. bytes_per_second refers to the file.
#include <benchmark/benchmark.h>

#include <cstring>
#include <string>

#include "kinemend/clean.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"

namespace {

using namespace kinemend;

const std::string& scene(const std::string& format) {
  static const Take take = synthesize({.motion = "stroll", .duration_s = 60});
  static const std::string fbx = write_take(take, "fbx"), glb = write_take(take, "glb");
  return format == "fbx" ? fbx : glb;
}

void count_bytes(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(bytes));
}

void read_scene(benchmark::State& state, const std::string& format) {
  const std::string& bytes = scene(format);
  for (auto _ : state) {
    const TakeResult read = read_take(bytes, "take." + format);
    benchmark::DoNotOptimize(read.take.rotations.data());
  }
  count_bytes(state, bytes.size());
}

// Every joint changes in every frame.
void rewrite_scene(benchmark::State& state, const std::string& format) {
  const std::string& bytes = scene(format);
  Take take = read_take(bytes, "take." + format).take;
  for (Quat& q : take.rotations) q = q * exp(Vec3{0.01, -0.02, 0.015});
  for (auto _ : state) benchmark::DoNotOptimize(write_take(take).data());
  count_bytes(state, bytes.size());
}

template <class Word>
void append(std::string& bytes, Word word) {
  bytes.append(reinterpret_cast<const char*>(&word), sizeof(Word));
}

// A record of version 7.5 that no reader uses: one array in place of a character's mesh and
// pictures.
std::string mesh_record(std::size_t place, std::size_t size) {
  const std::string name = "Mesh";
  constexpr std::size_t head = 25, array_head = 13;
  const std::size_t numbers = size / 8;
  std::string bytes;
  append(bytes, std::uint64_t{place + head + name.size() + array_head + 8 * numbers});
  append(bytes, std::uint64_t{1});
  append(bytes, std::uint64_t{array_head + 8 * numbers});
  bytes += static_cast<char>(name.size());
  bytes += name + "d";
  append(bytes, static_cast<std::uint32_t>(numbers));
  append(bytes, std::uint32_t{0});
  append(bytes, static_cast<std::uint32_t>(8 * numbers));
  Random random(1);
  for (std::size_t i = 0; i < numbers; ++i) append(bytes, random.normal());
  return bytes;
}

// The minute of motion in a file of 50 MB.
std::string character() {
  constexpr std::size_t file_bytes = 50'000'000, head = 27;
  std::string bytes = scene("fbx");
  const auto end_of = [&](std::size_t place) {
    std::uint64_t end = 0;
    std::memcpy(&end, bytes.data() + place, sizeof(end));
    return static_cast<std::size_t>(end);
  };
  std::size_t place = head;
  while (end_of(place) != 0) place = end_of(place);
  return bytes.insert(place, mesh_record(place, file_bytes - bytes.size()));
}

// Cleans from bytes to bytes, as the program does.
void clean_character(benchmark::State& state) {
  const std::string bytes = character();
  const auto cleaner = make_cleaner("learned");
  for (auto _ : state) {
    Take take = read_take(bytes, "take.fbx").take;
    const CleanResult result = clean_take(std::move(take), *cleaner, {});
    benchmark::DoNotOptimize(write_take(result.take).data());
  }
  count_bytes(state, bytes.size());
}

BENCHMARK(clean_character)
    ->Name("fbx/clean_character_of_50_MB")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(read_scene, fbx, "fbx")->Name("fbx/read")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_scene, glb, "glb")->Name("glb/read")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rewrite_scene, fbx, "fbx")->Name("fbx/rewrite")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rewrite_scene, glb, "glb")->Name("glb/rewrite")->Unit(benchmark::kMillisecond);

}  // namespace
