#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/corrupt.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/model.hpp"
#include "kinemend/random.hpp"
#include "kinemend/synth.hpp"
#include "kinemend/train.hpp"

// The method `wiener`: takes cleaned with the model that ships, as a whole and without what `auto`
// does beforehand, and training.
namespace {

using kinemend::Clip;

Clip walk(std::uint64_t seed, double rate_hz, double duration_s) {
  kinemend::SynthOptions options{
      .motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz};
  options.seed = seed;
  return kinemend::synthesize(options);
}

Clip noisy_walk(double rate_hz, double duration_s, double outlier_share) {
  Clip clip = walk(3, rate_hz, duration_s);
  kinemend::Random random(4);
  kinemend::apply_damage(clip, "gaussian", {{"std_deg", 3.0}}, random);
  if (outlier_share > 0)
    kinemend::apply_damage(clip, "outliers", {{"share", outlier_share}}, random);
  return clip;
}

void clean(benchmark::State& state, const kinemend::Cleaner& cleaner, const Clip& take) {
  for (auto _ : state) {
    Clip clip = take;
    cleaner.clean(clip, kinemend::Selection::all(clip));
    benchmark::DoNotOptimize(clip.local_rotations.data());
  }
  state.counters["ms per second"] = benchmark::Counter(
      1e-3 * static_cast<double>(take.frame_count()) / take.frame_rate_hz,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void clean_take(benchmark::State& state) {
  const auto take =
      noisy_walk(static_cast<double>(state.range(0)), static_cast<double>(state.range(1)), 0);
  clean(state, *kinemend::make_wiener(), take);
}
BENCHMARK(clean_take)
    ->ArgNames({"Hz", "s"})
    ->Args({30, 10})
    ->Args({30, 40})
    ->Args({120, 10})
    ->Args({120, 40})
    ->Unit(benchmark::kMillisecond);

void clean_dense_outliers(benchmark::State& state) {
  const auto take = noisy_walk(static_cast<double>(state.range(0)), 10, 0.1);
  clean(state, *kinemend::make_wiener(), take);
}
BENCHMARK(clean_dense_outliers)->ArgName("Hz")->Arg(30)->Arg(120)->Unit(benchmark::kMillisecond);

// What of that is `auto`.
void clean_by_auto(benchmark::State& state) {
  const auto take = noisy_walk(static_cast<double>(state.range(0)), 10, 0);
  clean(state, *kinemend::make_auto(), take);
}
BENCHMARK(clean_by_auto)->ArgName("Hz")->Arg(30)->Arg(120)->Unit(benchmark::kMillisecond);

// Ten walks of 10 s.
void training(benchmark::State& state) {
  std::vector<Clip> clips;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) clips.push_back(walk(seed, 120, 10));
  const kinemend::TrainingTakes takes{clips.size(), [&](std::size_t i) {
                                        return std::variant<Clip, kinemend::MarkerClip>(clips[i]);
                                      }};
  for (auto _ : state)
    benchmark::DoNotOptimize(kinemend::train_model("wiener", takes).tensors.size());
}
BENCHMARK(training)->Unit(benchmark::kMillisecond);

}  // namespace
