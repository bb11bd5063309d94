// Speed of filters on takes of 96 channels and 10,000 frames at 120 Hz, in frames/s.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/signal.hpp"

namespace {

using kinemend::PoseMatrix;

constexpr std::size_t frame_count = 10000;
constexpr std::size_t channel_count = 96;

PoseMatrix noisy_take() {
  PoseMatrix matrix(frame_count, channel_count);
  kinemend::Random random(1);
  for (std::size_t t = 0; t < frame_count; ++t) {
    for (std::size_t c = 0; c < channel_count; ++c) {
      const double phase = 0.03 * static_cast<double>(t) + 0.7 * static_cast<double>(c);
      matrix(t, c) = std::sin(phase) + 0.02 * random.normal();
    }
  }
  return matrix;
}

// Each round filters a fresh copy; the copying is not timed.
template <class Filter>
void run(benchmark::State& state, const Filter& filter) {
  const PoseMatrix take = noisy_take();
  PoseMatrix matrix = take;
  for (auto _ : state) {
    state.PauseTiming();
    matrix.values = take.values;
    state.ResumeTiming();
    filter(matrix);
    benchmark::DoNotOptimize(matrix.values.data());
    benchmark::ClobberMemory();
  }
  state.counters["frames/s"] = benchmark::Counter(static_cast<double>(frame_count),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void copy_alone(benchmark::State& state) {
  PoseMatrix other = noisy_take();
  run(state, [&](PoseMatrix& m) { other.values = m.values; });
}
BENCHMARK(copy_alone)->Name("signal/copy_alone")->Unit(benchmark::kMillisecond);

void butterworth_zero_phase_order_4(benchmark::State& state) {
  const auto sections = kinemend::butterworth_lowpass(4, 6, 120);
  run(state, [&](PoseMatrix& m) { kinemend::filter_zero_phase(m, sections); });
}
BENCHMARK(butterworth_zero_phase_order_4)
    ->Name("signal/butterworth_zero_phase_order_4")
    ->Unit(benchmark::kMillisecond);

void butterworth_causal_order_4(benchmark::State& state) {
  const auto sections = kinemend::butterworth_lowpass(4, 6, 120);
  run(state, [&](PoseMatrix& m) {
    kinemend::CausalState filter(sections);
    for (std::size_t t = 0; t < m.frames; ++t) filter.step(m.row(t));
  });
}
BENCHMARK(butterworth_causal_order_4)
    ->Name("signal/butterworth_causal_order_4")
    ->Unit(benchmark::kMillisecond);

void gaussian_sigma_3(benchmark::State& state) {
  run(state, [](PoseMatrix& m) { kinemend::gaussian_filter(m, 3); });
}
BENCHMARK(gaussian_sigma_3)->Name("signal/gaussian_sigma_3")->Unit(benchmark::kMillisecond);

void weighted_mean_passes(benchmark::State& state) {
  const int passes = static_cast<int>(state.range(0));
  run(state, [&](PoseMatrix& m) { kinemend::weighted_mean_filter(m, passes); });
}
BENCHMARK(weighted_mean_passes)
    ->Name("signal/weighted_mean_passes")
    ->Arg(1)
    ->Arg(4)
    ->Unit(benchmark::kMillisecond);

void median_half_window_5(benchmark::State& state) {
  run(state, [](PoseMatrix& m) { kinemend::median_filter(m, 5); });
}
BENCHMARK(median_half_window_5)->Name("signal/median_half_window_5")->Unit(benchmark::kMillisecond);

void wavelet_symlet_4(benchmark::State& state) {
  kinemend::WaveletOptions options;
  options.threshold = state.range(0) == 0 ? kinemend::WaveletThreshold::universal
                                          : kinemend::WaveletThreshold::sure;
  run(state, [&](PoseMatrix& m) { kinemend::wavelet_denoise(m, options); });
}
BENCHMARK(wavelet_symlet_4)
    ->Name("signal/wavelet_symlet_4")
    ->ArgName("sure")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

void fill_cubic_5_percent(benchmark::State& state) {
  std::vector<std::uint8_t> missing(frame_count * channel_count, 0);
  kinemend::Random random(2);
  for (auto& mark : missing) mark = random.chance(0.05);
  run(state, [&](PoseMatrix& m) { kinemend::fill_cubic(m, missing); });
}
BENCHMARK(fill_cubic_5_percent)->Name("signal/fill_cubic_5_percent")->Unit(benchmark::kMillisecond);

}  // namespace
