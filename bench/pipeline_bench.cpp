// Speed of cleaning a whole take of 31 joints and 10,000 frames at 120 Hz with one degree of noise,
// and of the same skeleton live. The first argument of a cleaning benchmark is the number of
// threads.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "kinemend/clean.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"

namespace {

using namespace kinemend;

constexpr std::size_t joint_count = 31;

Take noisy_take(std::size_t frames) {
  Take clip;
  for (std::size_t j = 0; j < joint_count; ++j) {
    clip.skeleton.add_joint("joint" + std::to_string(j), j == 0 ? -1 : static_cast<int>(j) - 1,
                            {0, 10, 0}, make_channels(j == 0, parse_rotation_order("ZYX")));
  }
  clip.frame_rate_hz = 120;
  clip.positions.resize(frames);
  clip.rotations.resize(frames * joint_count);
  Random random(1);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / 120;
    clip.root_position(f) = {100 * std::sin(t), 90 + random.normal(), 10 * t};
    for (std::size_t j = 0; j < joint_count; ++j) {
      const double phase = 4 * t + static_cast<double>(j);
      const double x = random.normal(), y = random.normal(), z = random.normal();
      clip.rotation(f, j) = exp({0.6 * std::sin(phase), 0.3 * std::cos(2 * phase), 0.2}) *
                            exp(radians_per_degree * Vec3{x, y, z});
    }
  }
  return clip;
}

const Take& long_take() {
  static const Take clip = noisy_take(10000);
  return clip;
}

void count_frames(benchmark::State& state, std::size_t frames) {
  state.counters["frames/s"] = benchmark::Counter(static_cast<double>(frames),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void clean_take(benchmark::State& state, const std::string& method) {
  const ThreadLimit control(static_cast<std::size_t>(state.range(0)));
  const Take& clip = long_take();
  const auto cleaner = make_cleaner(method);
  for (auto _ : state) benchmark::DoNotOptimize(clean_take(clip, *cleaner).take.rotations.data());
  count_frames(state, clip.frame_count());
}

// Runs the cleaner alone, without copy, blend and report.
void cleaner_alone(benchmark::State& state, const std::string& method) {
  const ThreadLimit control(static_cast<std::size_t>(state.range(0)));
  const auto cleaner = make_cleaner(method);
  Take clip = long_take();
  for (auto _ : state) {
    state.PauseTiming();
    clip.rotations = long_take().rotations;
    state.ResumeTiming();
    clean_in_place(*cleaner, clip);
  }
  count_frames(state, clip.frame_count());
}

void encode_and_decode(benchmark::State& state) {
  Take clip = long_take();
  const auto encoding = static_cast<Encoding>(state.range(0));
  for (auto _ : state) decode(encode(clip, encoding), clip);
  count_frames(state, clip.frame_count());
}

void live_frame(benchmark::State& state, const std::string& method) {
  const Take clip = noisy_take(600);
  const auto cleaner = make_cleaner(method);
  const auto stream = make_stream(*cleaner, clip);
  const TakeView view = view_of(clip);
  std::vector<Frame> frames;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) frames.push_back(frame_of(view, f));
  Frame out;
  std::size_t next = 0;
  for (auto _ : state) {
    stream->push(frames[next], out);
    benchmark::DoNotOptimize(out.rotations.data());
    next = (next + 1) % frames.size();
  }
  state.counters["latency_frames"] = static_cast<double>(stream->latency_frames());
  count_frames(state, 1);
}

// Registers each benchmark for every method in the table.
[[maybe_unused]] const int registered = [] {
  for (const Method& method : methods()) {
    if (method.learned) continue;  // they clean bodies; example_bench and wiener_bench measure them
    const std::string& name = method.name;
    benchmark::RegisterBenchmark(("pipeline/clean/" + name).c_str(), clean_take, name)
        ->Arg(1)
        ->Arg(2)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    benchmark::RegisterBenchmark(("pipeline/cleaner_alone/" + name).c_str(), cleaner_alone, name)
        ->Arg(1)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    if (make_cleaner(name)->live_support(120).runs()) {
      benchmark::RegisterBenchmark(("pipeline/live/" + name).c_str(), live_frame, name)
          ->Unit(benchmark::kMicrosecond);
    }
  }
  return 0;
}();

BENCHMARK(encode_and_decode)
    ->Name("pipeline/encode_and_decode")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
