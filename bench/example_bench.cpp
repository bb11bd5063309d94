// Speed of example-based denoising: matrix products, bases of 2,000 frames x 62 channels at 30 Hz
// (window 20), and cleaning takes of 10 s and more with these bases.
#include <benchmark/benchmark.h>

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/random.hpp"
#include "methods/prior/window_bases.hpp"
#include "nn/gemm.hpp"
#include "noisy_walk.hpp"
#include "papers/lou2010_example/example_filter.hpp"
#include "papers/lou2010_example/filter_bases.hpp"
#include "papers/lou2010_example/pattern_penalty.hpp"

namespace {

using kinemend::PoseMatrix;

constexpr std::size_t channel_count = 62;
constexpr std::size_t window_frames = 20;

// A gait of changing speed: harmonics of a wandering phase, slow drifts and small tremor, about as
// rich as walks of several people.
PoseMatrix gait(std::size_t frames, std::uint64_t seed) {
  constexpr std::size_t harmonics = 6, drifts = 12;
  kinemend::Random body(1), random(seed);
  std::vector<double> sizes(channel_count * harmonics), phases(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i] = 20 * body.normal() / std::pow(1.0 + static_cast<double>(i % harmonics), 2.0);
    phases[i] = 6.28 * body.uniform();
  }
  std::vector<double> loads(channel_count * drifts);
  for (double& load : loads) load = body.normal();
  std::vector<double> drift(drifts), speed(drifts);
  PoseMatrix poses(frames, channel_count);
  double phase = 0, pace = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    pace = 0.99 * pace + 0.003 * random.normal();
    phase += 0.2 * (1 + pace);
    for (std::size_t d = 0; d < drifts; ++d) {
      speed[d] = 0.8 * speed[d] + 0.1 * random.normal() - 0.01 * drift[d];
      drift[d] += speed[d];
    }
    for (std::size_t c = 0; c < channel_count; ++c) {
      double value = 0.05 * random.normal();
      for (std::size_t h = 0; h < harmonics; ++h) {
        const std::size_t i = c * harmonics + h;
        value += sizes[i] * std::sin(static_cast<double>(h + 1) * phase + phases[i]);
      }
      for (std::size_t d = 0; d < drifts; ++d) value += loads[c * drifts + d] * drift[d];
      poses(f, c) = value;
    }
  }
  return poses;
}

void product_of_square_matrices(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<double> a(n * n, 1.0), b(n * n, 1.0);
  std::vector<double> c(n * n);
  for (auto _ : state) {
    kinemend::nn::multiply({a.data(), n, n, n}, {b.data(), n, n, n}, {c.data(), n, n, n});
    benchmark::DoNotOptimize(c.data());
  }
  state.counters["flop/s"] = benchmark::Counter(2.0 * static_cast<double>(n * n * n),
                                                benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(product_of_square_matrices)
    ->Name("example/product_of_square_matrices")
    ->Arg(64)
    ->Arg(256)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);

// E^T z for all windows of 10 s.
void product_of_trajectories(benchmark::State& state) {
  const PoseMatrix take = gait(300, 2);
  const std::size_t side = window_frames * channel_count, count = 50;
  const std::size_t windows = take.frames - window_frames + 1;
  const std::vector<double> bases(side * count, 0.5);
  std::vector<double> coefficients(windows * count);
  for (auto _ : state) {
    kinemend::nn::multiply({take.values.data(), windows, side, channel_count},
                           {bases.data(), side, count, count},
                           {coefficients.data(), windows, count, count});
    benchmark::DoNotOptimize(coefficients.data());
  }
  state.counters["flop/s"] = benchmark::Counter(2.0 * static_cast<double>(windows * side * count),
                                                benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(product_of_trajectories)
    ->Name("example/product_of_trajectories")
    ->Unit(benchmark::kMillisecond);

void covariance(benchmark::State& state) {
  const PoseMatrix take = gait(2000, 1);
  for (auto _ : state) {
    kinemend::LagCovariance sums(window_frames, channel_count);
    sums.add(take);
    benchmark::DoNotOptimize(sums.covariance().data());
  }
}
BENCHMARK(covariance)->Name("example/covariance")->Unit(benchmark::kMillisecond);

void bases(benchmark::State& state) {
  const PoseMatrix take = gait(2000, 1);
  std::size_t count = 0;
  for (auto _ : state) {
    kinemend::LagCovariance sums(window_frames, channel_count);
    sums.add(take);
    count = kinemend::filter_bases(sums).count;
  }
  state.counters["bases"] = static_cast<double>(count);
}
BENCHMARK(bases)->Name("example/bases")->Unit(benchmark::kMillisecond);

std::vector<double> gait_covariance() {
  kinemend::LagCovariance sums(window_frames, channel_count);
  sums.add(gait(2000, 1));
  return sums.covariance();
}

constexpr std::size_t side = window_frames * channel_count;

void eigenvectors_by_energy(benchmark::State& state) {
  const std::vector<double> matrix = gait_covariance();
  const double energy = 1 - std::pow(10.0, -static_cast<double>(state.range(0)));
  std::size_t count = 0;
  for (auto _ : state) {
    count = kinemend::leading_eigenvectors(matrix, side, {.energy = energy}).values.size();
  }
  state.counters["bases"] = static_cast<double>(count);
}
BENCHMARK(eigenvectors_by_energy)
    ->Name("example/eigenvectors_by_energy")
    ->Arg(2)
    ->Arg(3)
    ->Arg(4)
    ->Unit(benchmark::kMillisecond);

void eigenvectors_of_eigen(benchmark::State& state) {
  const std::vector<double> matrix = gait_covariance();
  const Eigen::Map<const Eigen::MatrixXd> m(matrix.data(), side, side);
  for (auto _ : state) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m);
    benchmark::DoNotOptimize(solver.eigenvalues().data());
  }
}
BENCHMARK(eigenvectors_of_eigen)
    ->Name("example/eigenvectors_of_eigen")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);

// Cleans 3 degrees of noise and 5 % of outliers to convergence, starting at the measured motion,
// with the bases that hold 99 % of the energy or as many as five real walks need.
void clean_take(benchmark::State& state) {
  const double rate_hz = static_cast<double>(state.range(0));
  const auto frames = static_cast<std::size_t>(rate_hz * static_cast<double>(state.range(1)));
  kinemend::LagCovariance sums(window_frames, channel_count);
  sums.add(gait(2000, 1));
  const kinemend::FilterBases bases =
      kinemend::filter_bases(sums, {.count = static_cast<std::size_t>(state.range(2))});
  PoseMatrix take = gait(frames, 3);
  kinemend::Random random(4);
  for (double& value : take.values) {
    value += 3 * random.normal() + (random.uniform() < 0.05 ? 60 * random.normal() : 0.0);
  }
  kinemend::ExampleWeights weights;
  weights.data.assign(channel_count, 1.0);
  weights.welsch.assign(channel_count, 9.0);
  weights.prior.assign(channel_count, 1.0);
  std::size_t iterations = 0;
  for (auto _ : state) {
    PoseMatrix cleaned = take;
    const auto objective = kinemend::example_filter(
        cleaned, take, {}, kinemend::bases_at_rate(bases, 30, rate_hz, frames), bases.mean, weights,
        {.tolerance = 2e-3, .first_welsch = 8});
    iterations = objective.size() - 1;
    benchmark::DoNotOptimize(cleaned.values.data());
  }
  state.counters["bases"] = static_cast<double>(bases.count);
  state.counters["iterations"] = static_cast<double>(iterations);
  state.counters["ms per second"] = benchmark::Counter(
      static_cast<double>(state.range(1)) * 1e-3,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(clean_take)
    ->Name("example/clean_take")
    ->ArgNames({"Hz", "s", "bases"})
    ->Args({30, 10, 0})
    ->Args({30, 40, 0})
    ->Args({30, 160, 0})
    ->Args({120, 10, 0})
    ->Args({120, 40, 0})
    ->Args({30, 10, 105})
    ->Args({30, 40, 105})
    ->Args({120, 10, 105})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// Multiplies every sliding window by all bases, or computes the same product as a convolution.
void patterns_product(benchmark::State& state) {
  using Product = kinemend::PatternPenalty::Product;
  kinemend::LagCovariance sums(window_frames, channel_count);
  sums.add(gait(2000, 1));
  const kinemend::FilterBases bases = kinemend::filter_bases(sums, {.count = 105});
  const PoseMatrix take = gait(300, 3);
  PoseMatrix image = take;
  kinemend::PatternPenalty patterns(kinemend::bases_at_rate(bases, 30, 30, take.frames),
                                    std::vector<double>(channel_count, 2.0), {}, take.frames, 1,
                                    state.range(0) == 0 ? Product::windows : Product::frequencies);
  for (auto _ : state) {
    patterns.multiply(take, image);
    benchmark::DoNotOptimize(image.values.data());
  }
}
BENCHMARK(patterns_product)
    ->Name("example/patterns_product")
    ->ArgName("by frequencies")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// Cleans a whole take of 10 s at 30 Hz with the shipped model, including `auto`.
void method(benchmark::State& state) {
  const kinemend::Take take = kinemend::bench::noisy_walk(30, 10, 0.02);
  const auto cleaner = kinemend::make_example({});
  for (auto _ : state) {
    benchmark::DoNotOptimize(kinemend::clean_take(take, *cleaner));
  }
}
BENCHMARK(method)->Name("example/method")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
