// Speed of reading and writing C3D on a single thread: 41 markers in 30,000 frames, 4 analog
// channels. `items` are frames; bytes_per_second refers to the file.
#include <benchmark/benchmark.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

#include "io/c3d/c3d_layout.hpp"
#include "io/c3d/c3d_parameters.hpp"
#include "kinemend/io.hpp"

namespace {

using namespace kinemend;

constexpr std::size_t frame_count = 30000, marker_count = 41, analog_values = 4;

enum Encoding : std::int64_t { intel_real, mips_real, dec_real, intel_integer, dec_integer };

C3dProcessor processor_of(std::int64_t encoding) {
  if (encoding == dec_real || encoding == dec_integer) return C3dProcessor::dec;
  return encoding == mips_real ? C3dProcessor::mips : C3dProcessor::intel;
}

const char* name_of(std::int64_t encoding) {
  static const char* const names[] = {"Intel reals", "MIPS reals", "DEC reals", "Intel integers",
                                      "DEC integers"};
  return names[encoding];
}

// Every 50th sample is missing.
template <class Words>
void put_frames(std::string& bytes, bool real) {
  std::string frames(frame_count * (4 * marker_count + analog_values) * (real ? 4 : 2), '\0');
  char* p = frames.data();
  const auto put = [&](float value) {
    if (real) {
      Words::put_real(p, value);
    } else {
      Words::put_word(p, static_cast<std::uint16_t>(static_cast<std::int16_t>(value)));
    }
    p += real ? 4 : 2;
  };
  for (std::size_t f = 0; f < frame_count; ++f) {
    for (std::size_t m = 0; m < marker_count; ++m) {
      const bool missing = (f + m) % 50 == 0;
      const auto t = static_cast<float>(f) * 0.01f + static_cast<float>(m);
      for (const float value : {1000 * std::sin(t), 500 * std::cos(t), 900 + 10 * t})
        put(missing ? 0 : value);
      put(missing ? -1.0f : static_cast<float>(0x0703));
    }
    for (std::size_t i = 0; i < analog_values; ++i) put(static_cast<float>(i));
  }
  bytes += frames;
}

std::string make_take(std::int64_t encoding) {
  const bool real = encoding <= dec_real;
  const C3dProcessor processor = processor_of(encoding);
  return with_words(processor, [&](auto words) {
    using Words = decltype(words);
    std::string bytes(2 * c3d_block_bytes, '\0');
    bytes[0] = 2;
    bytes[1] = bytes[c3d_block_bytes + 1] = 0x50;
    bytes[c3d_block_bytes + 3] = static_cast<char>(processor);
    const auto put = [&](std::size_t word, std::size_t value) {
      Words::put_word(bytes.data() + 2 * (word - 1), static_cast<std::uint16_t>(value));
    };
    put(2, marker_count);
    put(3, analog_values);
    put(4, 1);
    put(5, frame_count);
    Words::put_real(bytes.data() + 12, real ? -0.1f : 0.1f);
    put(9, 3);
    put(10, 1);
    Words::put_real(bytes.data() + 20, 120.0f);
    put_frames<Words>(bytes, real);
    return bytes;
  });
}

void report(benchmark::State& state, std::size_t bytes) {
  state.SetLabel(name_of(state.range(0)));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(frame_count));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

// Reads a file from the disk cache, as a program does.
void read_c3d_file(benchmark::State& state) {
  const std::string bytes = make_take(state.range(0));
  const auto path = std::filesystem::temp_directory_path() /
                    ("kinemend_bench_" + std::to_string(::getpid()) + ".c3d");
  write_file(path, bytes, true);
  for (auto _ : state) {
    TakeResult result = read_take(path);
    benchmark::DoNotOptimize(result.take.positions.data());
  }
  std::filesystem::remove(path);
  report(state, bytes.size());
}
BENCHMARK(read_c3d_file)
    ->Name("c3d/read_c3d_file")
    ->DenseRange(intel_real, dec_integer)
    ->Unit(benchmark::kMillisecond);

void read_c3d_bytes(benchmark::State& state) {
  const std::string bytes = make_take(state.range(0));
  std::string copy = bytes;
  for (auto _ : state) {
    TakeResult result = read_take(std::move(copy), "take.c3d");
    benchmark::DoNotOptimize(result.take.positions.data());
    state.PauseTiming();
    result = {};
    copy = bytes;
    state.ResumeTiming();
  }
  report(state, bytes.size());
}
BENCHMARK(read_c3d_bytes)
    ->Name("c3d/read_c3d_bytes")
    ->DenseRange(intel_real, dec_integer)
    ->Unit(benchmark::kMillisecond);

void write_c3d(benchmark::State& state, double change) {
  const std::string bytes = make_take(state.range(0));
  Take clip = read_take(bytes, "take.c3d").take;
  for (Vec3& p : clip.positions) p.x += change;
  for (auto _ : state) benchmark::DoNotOptimize(write_take(clip, "c3d").data());
  report(state, bytes.size());
}
BENCHMARK_CAPTURE(write_c3d, unchanged, 0.0)
    ->Name("c3d/write_c3d/unchanged")
    ->DenseRange(intel_real, dec_integer)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_c3d, changed, 0.5)
    ->Name("c3d/write_c3d/changed")
    ->DenseRange(intel_real, dec_integer)
    ->Unit(benchmark::kMillisecond);

void write_new_c3d(benchmark::State& state) {
  Take clip = read_take(make_take(state.range(0)), "take.c3d").take;
  clip.source.document.reset();
  std::size_t bytes = 0;
  for (auto _ : state) bytes = write_take(clip, "c3d").size();
  report(state, bytes);
}
BENCHMARK(write_new_c3d)->Name("c3d/write_new_c3d")->Arg(intel_real)->Unit(benchmark::kMillisecond);

}  // namespace
