// Filling all gaps of a take of 41 markers at 120 Hz: 60 gaps of 10 to 200 frames in 4,500 frames,
// and the same density in longer takes. The result is in ms.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"

namespace {

using kinemend::Vec3;

constexpr std::size_t marker_count = 41;
constexpr std::size_t frames_per_gap = 75;

// Markers at the joints of a walker who turns around, each with independent sway.
kinemend::Take whole_take(std::size_t frames) {
  const kinemend::Take clip = kinemend::synthesize(
      {.motion = "stroll", .duration_s = (static_cast<double>(frames) + 1) / 120});
  std::vector<std::string> names;
  for (std::size_t m = 0; m < marker_count; ++m) names.push_back(fmt::format("m{}", m));
  kinemend::Take take = kinemend::make_marker_take(names, frames, 120);
  take.observed.assign(take.positions.size(), 1);
  kinemend::Random random(1);
  std::vector<Vec3> places;
  for (std::size_t m = 0; m < marker_count; ++m) {
    places.push_back({random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)});
  }
  for (std::size_t f = 0; f < frames; ++f) {
    const kinemend::Pose pose = kinemend::forward_kinematics(clip, f);
    for (std::size_t m = 0; m < marker_count; ++m) {
      const std::size_t joint = m % 24;
      const auto phase = 0.03 * static_cast<double>(f) + static_cast<double>(m);
      const Vec3 sway{0.4 * std::sin(phase), 0.4 * std::cos(1.3 * phase), 0.02 * random.normal()};
      take.position(f, m) =
          pose.positions[joint] + kinemend::rotate(pose.rotations[joint], places[m] + sway);
    }
  }
  return take;
}

kinemend::Take damaged_take(std::size_t frames) {
  kinemend::Take take = whole_take(frames);
  kinemend::Random random(2);
  for (std::size_t gap = 0; gap < frames / frames_per_gap; ++gap) {
    const std::size_t length = 10 + random.below(191);
    const std::size_t first = 1 + random.below(frames - length - 2);
    const kinemend::NamedGap named{take.names[random.below(marker_count)], first,
                                   first + length - 1};
    kinemend::mark_gaps(take, {&named, 1});
  }
  return take;
}

void fill(benchmark::State& state, const char* method) {
  const kinemend::Take damaged = damaged_take(static_cast<std::size_t>(state.range(0)));
  kinemend::FillSettings settings;
  settings.method = method;
  settings.fill_all = true;
  settings.donor = damaged.names[0];
  std::size_t filled = 0;
  for (auto _ : state) {
    state.PauseTiming();
    kinemend::Take take = damaged;
    state.ResumeTiming();
    filled = kinemend::fill_gaps(take, settings).filled();
    benchmark::DoNotOptimize(take.positions.data());
  }
  state.counters["gaps"] = static_cast<double>(filled);
}

// CPU time is the sum over all threads.
void settle(benchmark::internal::Benchmark* bench) {
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK_CAPTURE(fill, auto, "auto") -> Name("fill/fill/auto") -> Arg(4500) -> Arg(18000)
    -> Arg(71900) -> Apply(settle);
BENCHMARK_CAPTURE(fill, spline, "spline")->Name("fill/fill/spline")->Arg(4500)->Apply(settle);
BENCHMARK_CAPTURE(fill, quintic, "quintic")->Name("fill/fill/quintic")->Arg(4500)->Apply(settle);
BENCHMARK_CAPTURE(fill, pattern, "pattern")->Name("fill/fill/pattern")->Arg(4500)->Apply(settle);
BENCHMARK_CAPTURE(fill, rigid_body, "rigid-body")
    ->Name("fill/fill/rigid_body")
    ->Arg(4500)
    ->Apply(settle);
BENCHMARK_CAPTURE(fill, pca, "pca")->Name("fill/fill/pca")->Arg(4500)->Apply(settle);
BENCHMARK_CAPTURE(fill, local_regression, "local-regression")
    ->Name("fill/fill/local_regression")
    ->Arg(4500)
    ->Apply(settle);
BENCHMARK_CAPTURE(fill, cyclic, "cyclic")->Name("fill/fill/cyclic")->Arg(4500)->Apply(settle);

}  // namespace
