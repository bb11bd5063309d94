#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/random.hpp"
#include "kinemend/methods.hpp"
#include "noisy_walk.hpp"
#include "sparse/batch_omp.hpp"
#include "sparse/descent_solver.hpp"
#include "sparse/dual_solver.hpp"
#include "sparse/ksvd.hpp"

// Dictionaries and codes (bench/sklearn_sparse.py has the same jobs), and the method `sparse` on
// takes with the model that ships.
namespace {

using kinemend::Random;
namespace sparse = kinemend::sparse;

constexpr std::size_t rows = 360, directions = 40;

// Windows that are sums of smooth directions of falling size, with noise.
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
    ->ArgName("windows")
    ->Arg(20'000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

void batch_omp(benchmark::State& state) {
  const std::vector<float> signals = windows(2000, 0.01);
  const sparse::BatchOmp omp(dictionary());
  for (auto _ : state)
    benchmark::DoNotOptimize(omp.code(signals, {.most_atoms = 10}).values.data());
}
BENCHMARK(batch_omp)->Unit(benchmark::kMillisecond)->UseRealTime();

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
BENCHMARK(descend)->ArgName("p")->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

void dual(benchmark::State& state) {
  solve(state, state.range(0) == 2 ? sparse::Loss::squares : sparse::Loss::absolute,
        [](const auto& atoms, const auto& problem) { return solve_sparse(atoms, problem); });
}
BENCHMARK(dual)->ArgName("p")->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

void clean_take(benchmark::State& state) {
  const auto take = kinemend::bench::noisy_walk(static_cast<double>(state.range(0)), 10, 0);
  const auto cleaner = kinemend::make_sparse();
  for (auto _ : state) {
    kinemend::Clip clip = take;
    clean_in_place(*cleaner, clip);
    benchmark::DoNotOptimize(clip.local_rotations.data());
  }
  state.counters["ms per second"] = benchmark::Counter(
      1e-3 * static_cast<double>(take.frame_count()) / take.frame_rate_hz,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(clean_take)
    ->ArgName("Hz")
    ->Arg(30)
    ->Arg(120)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
