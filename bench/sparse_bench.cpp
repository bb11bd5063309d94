// Speed of dictionaries and codes (bench/sklearn_sparse.py does the same jobs), and of the method
// `sparse` with the shipped model.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/random.hpp"
#include "noisy_walk.hpp"
#include "papers/xiao2015_sparse/descent_solver.hpp"
#include "papers/xiao2015_sparse/dictionary.hpp"
#include "papers/xiao2015_sparse/dual_solver.hpp"
#include "papers/xiao2015_sparse/sparse_filter.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace {

using kinemend::Random;
namespace sparse = kinemend::sparse;

constexpr std::size_t rows = 360, directions = 40;

// Windows that are sums of smooth directions of decreasing size, with noise.
std::vector<float> windows(std::size_t count, double noise) {
  Random random(1);
  std::vector<float> basis(directions * rows);
  for (std::size_t k = 0; k < directions; ++k) {
    for (std::size_t r = 0; r < rows; ++r)
      basis[k * rows + r] = static_cast<float>(
          std::cos(0.01 * static_cast<double>((k + 1) * (r + 1))) / std::sqrt(0.5 * rows));
  }
  std::vector<float> result(count * rows);
  for (std::size_t s = 0; s < count; ++s) {
    for (std::size_t k = 0; k < directions; ++k) {
      const auto weight = static_cast<float>(random.normal() * std::pow(0.9, k));
      for (std::size_t r = 0; r < rows; ++r) result[s * rows + r] += weight * basis[k * rows + r];
    }
    for (std::size_t r = 0; r < rows; ++r)
      result[s * rows + r] += static_cast<float>(noise * random.normal());
  }
  return result;
}

const sparse::Dictionary& dictionary() {
  static const sparse::Dictionary learned =
      sparse::ksvd(windows(4000, 0), rows, {.atoms = 800, .iterations = 3}).dictionary;
  return learned;
}

void learn_dictionary(benchmark::State& state) {
  const std::vector<float> signals = windows(static_cast<std::size_t>(state.range(0)), 0);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        sparse::ksvd(signals, rows, {.atoms = 800, .sparsity = 10, .iterations = 10}).objective);
}
BENCHMARK(learn_dictionary)
    ->Name("sparse/learn_dictionary")
    ->ArgName("windows")
    ->Arg(20'000)
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1);

void batch_omp(benchmark::State& state) {
  const std::vector<float> signals = windows(2000, 0.01);
  const sparse::BatchOmp omp(dictionary());
  for (auto _ : state)
    benchmark::DoNotOptimize(omp.code(signals, {.most_atoms = 10}).values.data());
}
BENCHMARK(batch_omp)
    ->Name("sparse/batch_omp")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

template <class Solve>
void solve(benchmark::State& state, sparse::Loss loss, const Solve& solution) {
  const std::vector<float> values = windows(256, 0.01);
  const std::vector<double> signals(values.begin(), values.end());
  const double noise = loss == sparse::Loss::squares ? 2 * 0.01 : 1;
  const std::vector<double> lambdas(256, 0.25 * noise * std::sqrt(2 * std::log(800)));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        solution(dictionary(), sparse::SparseProblem{loss, signals, {}, lambdas, {}}).codes.data());
}

void descend(benchmark::State& state) {
  solve(state, state.range(0) == 2 ? sparse::Loss::squares : sparse::Loss::absolute,
        [](const auto& atoms, const auto& problem) { return descend_sparse(atoms, problem); });
}
BENCHMARK(descend)
    ->Name("sparse/descend")
    ->ArgName("p")
    ->Arg(2)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void dual(benchmark::State& state) {
  solve(state, state.range(0) == 2 ? sparse::Loss::squares : sparse::Loss::absolute,
        [](const auto& atoms, const auto& problem) { return solve_sparse(atoms, problem); });
}
BENCHMARK(dual)
    ->Name("sparse/dual")
    ->ArgName("p")
    ->Arg(2)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// Windows of an arm in a noisy walk, a quarter of a window apart as in the method, for the shipped
// model. They show the gain of warm starts and working sets.
struct ArmWindows {
  sparse::Dictionary atoms;
  std::vector<double> signals, lambdas;  // in units of the noise

  std::size_t count() const { return lambdas.size(); }
  // Every other window, from the first or second one on.
  ArmWindows half(std::size_t first) const {
    ArmWindows result{atoms, {}, {}};
    for (std::size_t s = first; s < count(); s += 2) {
      const auto from = signals.begin() + static_cast<std::ptrdiff_t>(s * atoms.rows);
      result.signals.insert(result.signals.end(), from,
                            from + static_cast<std::ptrdiff_t>(atoms.rows));
      result.lambdas.push_back(lambdas[s]);
    }
    return result;
  }
  sparse::SparseProblem problem(sparse::Loss loss, std::span<const double> start = {}) const {
    return {loss, signals, {}, lambdas, start};
  }
};

ArmWindows arm_windows(sparse::Loss loss) {
  constexpr double noise = 0.01;  // body heights
  const auto model = kinemend::shipped_model("sparse");
  const kinemend::SparsePrior prior = kinemend::sparse_prior_of(*model);
  const kinemend::SparsePoselet& arm = prior.poselets[1];
  const auto take = kinemend::bench::noisy_walk(120, 3, 0);
  const auto channels =
      kinemend::encode_body(take, model->layout, kinemend::match_body(model->layout, take));
  const auto positions = kinemend::points_of(prior.points, model->layout, channels.poses);
  const std::size_t frames = 2 * prior.window_frames, width = arm.channels();
  ArmWindows result{kinemend::dictionary_at_rate(arm, prior.window_frames, frames), {}, {}};
  for (std::size_t first = 0; first + frames <= positions.frames; first += frames / 4) {
    for (std::size_t i = 0; i < frames * width; ++i) {
      const auto point = static_cast<std::size_t>(arm.points[i % width / 3]);
      const double value = positions(first + i / width, 3 * point + i % 3);
      result.signals.push_back((value - arm.mean[i % width]) / noise);
    }
    const double squares = loss == sparse::Loss::squares ? 2 : 1;
    result.lambdas.push_back(0.1 * squares *
                             std::sqrt(2 * std::log(static_cast<double>(result.atoms.atoms))));
  }
  return result;
}

sparse::Loss loss_of(std::int64_t p) {
  return p == 2 ? sparse::Loss::squares : sparse::Loss::absolute;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// With a warm start, every second window starts at the code of the one before.
void descend_overlapping(benchmark::State& state) {
  const sparse::Loss loss = loss_of(state.range(0));
  const ArmWindows all = arm_windows(loss);
  const ArmWindows even = all.half(0), odd = all.half(1);
  double objective = 0;
  for (auto _ : state) {
    if (state.range(1) == 0) {
      objective = mean_of(descend_sparse(all.atoms, all.problem(loss)).objectives);
      continue;
    }
    const auto first = descend_sparse(even.atoms, even.problem(loss));
    const std::span<const double> start(first.codes.data(), odd.count() * odd.atoms.atoms);
    const auto second = descend_sparse(odd.atoms, odd.problem(loss, start));
    objective = 0.5 * (mean_of(first.objectives) + mean_of(second.objectives));
  }
  state.counters["objective"] = objective;
}
BENCHMARK(descend_overlapping)
    ->Name("sparse/descend_overlapping")
    ->ArgNames({"p", "warm"})
    ->ArgsProduct({{2, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

// `batch` adjacent windows share a working set that starts with `atoms` of each.
void dual_overlapping(benchmark::State& state) {
  const sparse::Loss loss = loss_of(state.range(0));
  const ArmWindows all = arm_windows(loss);
  sparse::DualSettings settings;
  settings.batch = static_cast<std::size_t>(state.range(1));
  settings.first_atoms = static_cast<std::size_t>(state.range(2));
  double objective = 0;
  for (auto _ : state)
    objective = mean_of(solve_sparse(all.atoms, all.problem(loss), settings).objectives);
  state.counters["objective"] = objective;
}
BENCHMARK(dual_overlapping)
    ->Name("sparse/dual_overlapping")
    ->ArgNames({"p", "batch", "atoms"})
    ->ArgsProduct({{2, 1}, {1, 4, 16}, {8}})
    ->Args({2, 4, 1000})
    ->Args({1, 4, 1000})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void clean_take(benchmark::State& state) {
  const auto take = kinemend::bench::noisy_walk(static_cast<double>(state.range(0)), 10, 0);
  const auto cleaner = kinemend::make_sparse();
  for (auto _ : state) {
    kinemend::Take clip = take;
    clean_in_place(*cleaner, clip);
    benchmark::DoNotOptimize(clip.rotations.data());
  }
  state.counters["ms per second"] = benchmark::Counter(
      1e-3 * static_cast<double>(take.frame_count()) / take.frame_rate_hz,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(clean_take)
    ->Name("sparse/clean_take")
    ->ArgName("Hz")
    ->Arg(30)
    ->Arg(120)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
