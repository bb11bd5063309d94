// Tests of coordinate descent for sparse codes, against the exact solver.
#include "papers/xiao2015_sparse/descent_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "papers/xiao2015_sparse/support.hpp"

namespace kinemend::sparse {
namespace {

struct TwoAtomProblems {
  Dictionary dictionary;
  std::vector<double> signals, weights, lambdas;
  SparseProblem as(Loss loss) const { return {loss, signals, weights, lambdas, {}}; }
};

TwoAtomProblems two_atom_problems(std::size_t rows, std::size_t atoms, std::size_t count,
                                  double lambda, std::uint64_t seed) {
  TwoAtomProblems problems{random_dictionary(rows, atoms, seed), {}, {}, {}};
  Random random(seed + 100);
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t one = random.below(atoms), other = random.below(atoms);
    for (std::size_t r = 0; r < rows; ++r) {
      problems.signals.push_back(4 * problems.dictionary.atom(one)[r] -
                                 3 * problems.dictionary.atom(other)[r] + 0.1 * random.normal() +
                                 (random.chance(0.1) ? 2 * random.normal() : 0));
      problems.weights.push_back(random.chance(0.1) ? 0 : random.uniform(0.5, 2));
    }
    problems.lambdas.push_back(lambda);
  }
  return problems;
}

TEST(DescentSolver, FindsTheSquaresMinimumOfTheDualSolver) {
  const TwoAtomProblems problems = two_atom_problems(30, 90, 70, 0.8, 1);
  DescentSettings settings;
  settings.tolerance = 1e-5;
  settings.sweeps = 10'000;
  settings.rounds = 100;
  const SparseSolution quick =
      descend_sparse(problems.dictionary, problems.as(Loss::squares), settings);
  const SparseSolution exact = solve_sparse(problems.dictionary, problems.as(Loss::squares),
                                            {.tolerance = 1e-7, .iterations = 10'000});
  for (std::size_t s = 0; s < problems.lambdas.size(); ++s)
    EXPECT_NEAR(quick.objectives[s], exact.objectives[s], 1e-4 * exact.objectives[s]);
}

TEST(DescentSolver, ComesNearTheAbsoluteMinimumAndNeverBelow) {
  const TwoAtomProblems problems = two_atom_problems(40, 60, 30, 0.6, 2);
  const SparseSolution quick = descend_sparse(problems.dictionary, problems.as(Loss::absolute));
  const SparseSolution exact = solve_sparse(problems.dictionary, problems.as(Loss::absolute),
                                            {.tolerance = 1e-4, .iterations = 10'000});
  for (std::size_t s = 0; s < problems.lambdas.size(); ++s) {
    EXPECT_GE(quick.objectives[s], exact.objectives[s] * (1 - 2e-4));
    EXPECT_LE(quick.objectives[s], exact.objectives[s] * 1.15);
  }
}

TEST(DescentSolver, KeepsASpikeOutOfTheAbsoluteFit) {
  const Dictionary dictionary = random_dictionary(60, 80, 12);
  std::vector<double> clean(60), signal(60);
  for (std::size_t r = 0; r < 60; ++r)
    clean[r] = signal[r] = 4 * dictionary.atom(7)[r] - 3 * dictionary.atom(20)[r];
  signal[13] += 10;
  const std::vector<double> lambda{0.3};
  const SparseSolution solution =
      descend_sparse(dictionary, {Loss::absolute, signal, {}, lambda, {}});
  for (std::size_t r = 0; r < 60; ++r) EXPECT_NEAR(solution.reconstructed[r], clean[r], 0.1);
}

TEST(DescentSolver, TakesSignalsOfZerosAndOfNothingButGaps) {
  const Dictionary dictionary = random_dictionary(10, 20, 15);
  std::vector<double> signals(20, 0.0), weights(20, 1.0);
  const std::vector<double> lambdas(2, 1.0);
  std::fill(signals.begin() + 10, signals.end(), 3.0);
  std::fill(weights.begin() + 10, weights.end(), 0.0);
  for (const Loss loss : {Loss::squares, Loss::absolute}) {
    const SparseSolution solution =
        descend_sparse(dictionary, {loss, signals, weights, lambdas, {}});
    for (const double value : solution.reconstructed) EXPECT_EQ(value, 0);
  }
  EXPECT_TRUE(descend_sparse(dictionary, {}).codes.empty());
}

}  // namespace
}  // namespace kinemend::sparse
