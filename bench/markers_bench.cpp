// Speed of every method on 41 markers and on 31 joints of the same motion, 1,200 frames.
#include <benchmark/benchmark.h>

#include "kinemend/clean.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {
namespace {

Take noisy_walk() {
  SynthOptions options;
  options.duration_s = 10;
  Take clip = synthesize(options);
  Random random(1);
  apply_damage(clip, "gaussian", {{"std_deg", 1.0}}, random);
  return clip;
}

// Joint positions as markers, repeated to give 41 of them.
Take noisy_markers() {
  constexpr std::size_t count = 41;
  const Take joints = joint_markers(noisy_walk(), true);
  std::vector<std::string> names;
  for (std::size_t m = 0; m < count; ++m) names.push_back("M" + std::to_string(m));
  Take clip = make_marker_take(names, joints.frame_count(), joints.frame_rate_hz);
  clip.observed.assign(clip.positions.size(), 1);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 0; m < count; ++m)
      clip.position(f, m) =
          joints.position(f, m % joints.marker_count()) + Vec3{0.1 * static_cast<double>(m), 0, 0};
  }
  return clip;
}

void clean_joints_by(benchmark::State& state, const std::string& method) {
  static const Take clip = noisy_walk();
  const auto cleaner = make_cleaner(method);
  for (auto _ : state) {
    Take copy = clip;
    clean_in_place(*cleaner, copy);
    benchmark::DoNotOptimize(copy.rotations.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * clip.frame_count()));
}

void clean_markers_by(benchmark::State& state, const std::string& method) {
  static const Take clip = noisy_markers();
  const auto cleaner = make_cleaner(method);
  for (auto _ : state) {
    Take copy = clip;
    clean_in_place(*cleaner, copy);
    benchmark::DoNotOptimize(copy.positions.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * clip.frame_count()));
}

const bool registered = [] {
  for (const Method& method : methods()) {
    if (method.learned) continue;
    const std::string name = method.name;
    benchmark::RegisterBenchmark(("markers/joints/" + name).c_str(), clean_joints_by, name)
        ->MeasureProcessCPUTime()
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("markers/markers/" + name).c_str(), clean_markers_by, name)
        ->MeasureProcessCPUTime()
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace kinemend
