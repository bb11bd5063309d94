// Speed of FBX and glTF, single thread: a minute of 31 joints at 120 Hz with a key in each frame,
// as files of Kinemend's own. The number shown as bytes_per_second is of the file.
#include <benchmark/benchmark.h>

#include <string>

#include "kinemend/experimental/synth.hpp"
#include "kinemend/io.hpp"

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

BENCHMARK_CAPTURE(read_scene, fbx, "fbx")->Name("fbx/read")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_scene, glb, "glb")->Name("glb/read")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rewrite_scene, fbx, "fbx")->Name("fbx/rewrite")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rewrite_scene, glb, "glb")->Name("glb/rewrite")->Unit(benchmark::kMillisecond);

}  // namespace
