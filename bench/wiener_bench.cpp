// Speed of the method `wiener`: cleaning with the shipped model, as a whole and the share of
// `auto`, and training.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/lab/train.hpp"
#include "noisy_walk.hpp"

namespace {

using kinemend::Take;
using kinemend::bench::noisy_walk;
using kinemend::bench::walk;

void clean(benchmark::State& state, const kinemend::Cleaner& cleaner, const Take& take) {
  for (auto _ : state) {
    Take clip = take;
    clean_in_place(cleaner, clip);
    benchmark::DoNotOptimize(clip.rotations.data());
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
    ->Name("wiener/clean_take")
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
BENCHMARK(clean_dense_outliers)
    ->Name("wiener/clean_dense_outliers")
    ->ArgName("Hz")
    ->Arg(30)
    ->Arg(120)
    ->Unit(benchmark::kMillisecond);

// The share of `auto`.
void clean_by_auto(benchmark::State& state) {
  const auto take = noisy_walk(static_cast<double>(state.range(0)), 10, 0);
  clean(state, *kinemend::make_auto(), take);
}
BENCHMARK(clean_by_auto)
    ->Name("wiener/clean_by_auto")
    ->ArgName("Hz")
    ->Arg(30)
    ->Arg(120)
    ->Unit(benchmark::kMillisecond);

// Trains on ten walks of 10 s.
void training(benchmark::State& state) {
  std::vector<Take> clips;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) clips.push_back(walk(seed, 120, 10));
  const kinemend::TrainingTakes takes{clips.size(),
                                      [&](std::size_t i) { return kinemend::Take(clips[i]); }};
  for (auto _ : state)
    benchmark::DoNotOptimize(kinemend::train_model("wiener", takes).tensors.size());
}
BENCHMARK(training)->Name("wiener/training")->Unit(benchmark::kMillisecond);

}  // namespace
