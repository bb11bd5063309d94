// Speed of cleaners on whole takes in memory with one thread. Items are frames.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/system.hpp"

namespace {

using namespace kinemend;

Take noisy_clip(std::size_t joints, std::size_t frames, double rate_hz) {
  Take clip;
  clip.frame_rate_hz = rate_hz;
  const RotationOrder order = parse_rotation_order("ZXY");
  for (std::size_t j = 0; j < joints; ++j) {
    clip.skeleton.add_joint("joint" + std::to_string(j), static_cast<std::int32_t>(j) - 1,
                            {1, 0, 0}, make_channels(j == 0, order));
  }
  Random random(1);
  const auto noise = [&random] { return 0.026 * random.normal(); };  // 1.5 degrees
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / rate_hz;
    clip.positions.push_back({t, noise(), noise()});
    for (std::size_t j = 0; j < joints; ++j) {
      const double phase = 0.4 * static_cast<double>(j);
      clip.rotations.push_back(exp({0.5 * std::sin(6 * t + phase) + noise(),
                                    0.3 * std::cos(4 * t + phase) + noise(), noise()}));
    }
  }
  return clip;
}

void run(benchmark::State& state, const Cleaner& cleaner, const Take& input) {
  const ThreadLimit one_thread(1);
  Take clip = input;
  for (auto _ : state) {
    state.PauseTiming();
    clip.rotations = input.rotations;
    clip.positions = input.positions;
    state.ResumeTiming();
    clean_in_place(cleaner, clip);
    benchmark::DoNotOptimize(clip.rotations.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(input.frame_count()));
}

// Courty's take and parameters: 75 joints, 150 frames, 5 passes, sigma_t of one frame. His laptop
// took 300 ms.
void bilateral_75_joints_150_frames_5_passes(benchmark::State& state) {
  BilateralOptions options;
  options.sigma_t_s = 1.0 / 120;
  options.sigma_g_deg = 11.5;
  run(state, *make_bilateral(options), noisy_clip(75, 150, 120));
}
BENCHMARK(bilateral_75_joints_150_frames_5_passes)
    ->Name("clean/bilateral_75_joints_150_frames_5_passes")
    ->Unit(benchmark::kMillisecond);

void bilateral_wide_75_joints_150_frames_5_passes(benchmark::State& state) {
  BilateralOptions options;
  options.sigma_t_s = 0.03;
  run(state, *make_bilateral(options), noisy_clip(75, 150, 120));
}
BENCHMARK(bilateral_wide_75_joints_150_frames_5_passes)
    ->Name("clean/bilateral_wide_75_joints_150_frames_5_passes")
    ->Unit(benchmark::kMillisecond);

void bilateral_31_joints(benchmark::State& state) {
  run(state, *make_bilateral(), noisy_clip(31, 10000, 120));
}
BENCHMARK(bilateral_31_joints)->Name("clean/bilateral_31_joints")->Unit(benchmark::kMillisecond);

void gaussian_31_joints(benchmark::State& state) {
  run(state, *make_gaussian(), noisy_clip(31, 10000, 120));
}
BENCHMARK(gaussian_31_joints)->Name("clean/gaussian_31_joints")->Unit(benchmark::kMillisecond);

// Window of 21 poses, patch of 11, 93 rotation channels.
void nonlocal_31_joints_window_21_patch_11(benchmark::State& state) {
  NonlocalOptions options;
  options.bandwidth_deg = 1.5;
  run(state, *make_nonlocal(options), noisy_clip(31, 10000, 120));
}
BENCHMARK(nonlocal_31_joints_window_21_patch_11)
    ->Name("clean/nonlocal_31_joints_window_21_patch_11")
    ->Unit(benchmark::kMillisecond);

// The same take with a bandwidth chosen by its noise.
void nonlocal_31_joints_automatic(benchmark::State& state) {
  run(state, *make_nonlocal(), noisy_clip(31, 10000, 120));
}
BENCHMARK(nonlocal_31_joints_automatic)
    ->Name("clean/nonlocal_31_joints_automatic")
    ->Unit(benchmark::kMillisecond);

void nonlocal_31_joints_causal(benchmark::State& state) {
  NonlocalOptions options;
  options.causal = true;
  run(state, *make_nonlocal(options), noisy_clip(31, 1000, 120));
}
BENCHMARK(nonlocal_31_joints_causal)
    ->Name("clean/nonlocal_31_joints_causal")
    ->Unit(benchmark::kMillisecond);

// Compares every pose with every other one.
void nonlocal_31_joints_whole_take_of_1000(benchmark::State& state) {
  NonlocalOptions options;
  options.window_s = 0;
  options.bandwidth_deg = 0.5;
  run(state, *make_nonlocal(options), noisy_clip(31, 1000, 120));
}
BENCHMARK(nonlocal_31_joints_whole_take_of_1000)
    ->Name("clean/nonlocal_31_joints_whole_take_of_1000")
    ->Unit(benchmark::kMillisecond);

}  // namespace
