// Tests of the exact solver of sparse codes, against coordinate descent and optimality conditions.
#include "papers/xiao2015_sparse/dual_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "papers/xiao2015_sparse/support.hpp"

namespace kinemend::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr DualSettings exact{.tolerance = 1e-9, .iterations = 20'000};
// The minimum of a linear problem is a vertex, which the method approaches slowly.
constexpr DualSettings near{.tolerance = 1e-5, .iterations = 5000};

struct Problems {
  Dictionary dictionary;
  std::vector<double> signals, weights, lambdas;
  std::size_t count() const { return lambdas.size(); }
  SparseProblem as(Loss loss) const { return {loss, signals, weights, lambdas, {}}; }
  VectorXd signal(std::size_t s) const { return row(signals, s); }
  VectorXd weight(std::size_t s) const { return row(weights, s); }
  VectorXd row(const std::vector<double>& values, std::size_t s) const {
    return Eigen::Map<const VectorXd>(values.data() + s * dictionary.rows,
                                      static_cast<Index>(dictionary.rows));
  }
};

// Sums of three atoms with noise and outliers; weights of 0.5 to 2, one row in ten missing.
Problems random_problems(std::size_t rows, std::size_t atoms, std::size_t count, double lambda,
                         std::uint64_t seed) {
  Problems problems{random_dictionary(rows, atoms, seed), {}, {}, {}};
  Random random(seed + 100);
  for (std::size_t s = 0; s < count; ++s) {
    std::vector<double> signal(rows);
    for (int i = 0; i < 3; ++i) {
      const std::size_t atom = random.below(atoms);
      const double weight = 3 * random.normal();
      for (std::size_t r = 0; r < rows; ++r)
        signal[r] += weight * problems.dictionary.atom(atom)[r];
    }
    for (std::size_t r = 0; r < rows; ++r) {
      problems.signals.push_back(signal[r] + 0.1 * random.normal() +
                                 (random.chance(0.1) ? 2 * random.normal() : 0));
      problems.weights.push_back(random.chance(0.1) ? 0 : random.uniform(0.5, 2));
    }
    problems.lambdas.push_back(lambda * random.uniform(0.5, 2));
  }
  return problems;
}

double objective(const Problems& problems, std::size_t s, Loss loss, const VectorXd& code) {
  const VectorXd left = problems.signal(s) - matrix_of(problems.dictionary) * code;
  const double data = loss == Loss::squares ? problems.weight(s).dot(left.cwiseAbs2())
                                            : problems.weight(s).dot(left.cwiseAbs());
  return data + problems.lambdas[s] * code.cwiseAbs().sum();
}

VectorXd code_of(const SparseSolution& solution, const Problems& problems, std::size_t s) {
  return Eigen::Map<const VectorXd>(solution.codes.data() + s * problems.dictionary.atoms,
                                    static_cast<Index>(problems.dictionary.atoms));
}

// Cyclic coordinate descent to convergence.
VectorXd by_coordinate_descent(const Problems& problems, std::size_t s) {
  const MatrixXd d = matrix_of(problems.dictionary);
  const VectorXd w = problems.weight(s);
  VectorXd code = VectorXd::Zero(d.cols()), left = problems.signal(s);
  for (int round = 0; round < 100'000; ++round) {
    double moved = 0;
    for (Index k = 0; k < d.cols(); ++k) {
      const double curvature = 2 * w.dot(d.col(k).cwiseAbs2());
      const double slope = 2 * d.col(k).dot(w.cwiseProduct(left)) + curvature * code(k);
      const double size = std::max(std::abs(slope) - problems.lambdas[s], 0.0) / curvature;
      const double next = slope < 0 ? -size : size;
      left -= (next - code(k)) * d.col(k);
      moved = std::max(moved, std::abs(next - code(k)));
      code(k) = next;
    }
    if (moved < 1e-13) break;
  }
  return code;
}

// The l1/l1 problem is linear: its minimum is a vertex at which as many residuals and codes are
// zero as there are atoms. All vertices are tried.
double by_corners(const Problems& problems, std::size_t s) {
  const MatrixXd d = matrix_of(problems.dictionary);
  const Index atoms = d.cols(), planes = d.rows() + atoms;
  MatrixXd all(planes, atoms);
  all << d, MatrixXd::Identity(atoms, atoms);
  VectorXd values = VectorXd::Zero(planes);
  values.head(d.rows()) = problems.signal(s);
  double best = std::numeric_limits<double>::infinity();
  for (unsigned chosen = 0; chosen < (1U << planes); ++chosen) {
    if (__builtin_popcount(chosen) != atoms) continue;
    MatrixXd system(atoms, atoms);
    VectorXd right(atoms);
    Index n = 0;
    for (Index i = 0; i < planes; ++i) {
      if ((chosen >> i & 1U) == 0) continue;
      system.row(n) = all.row(i);
      right(n++) = values(i);
    }
    const Eigen::FullPivLU<MatrixXd> factor(system);
    if (!factor.isInvertible()) continue;
    best = std::min(best, objective(problems, s, Loss::absolute, factor.solve(right)));
  }
  return best;
}

TEST(DualSolver, FindsTheSquaresMinimumOfCoordinateDescent) {
  const Problems problems = random_problems(15, 40, 30, 0.5, 1);
  const SparseSolution solution =
      solve_sparse(problems.dictionary, problems.as(Loss::squares), exact);
  for (std::size_t s = 0; s < problems.count(); ++s) {
    const VectorXd expected = by_coordinate_descent(problems, s);
    const VectorXd found = code_of(solution, problems, s);
    const double least = objective(problems, s, Loss::squares, expected);
    EXPECT_NEAR(objective(problems, s, Loss::squares, found), least, 1e-8 * least);
    EXPECT_NEAR(solution.objectives[s], least, 1e-8 * least);
    EXPECT_LT((found - expected).norm(), 1e-3 * (1 + expected.norm()));
  }
}

TEST(DualSolver, MeetsTheConditionsOfTheSquaresMinimum) {
  const Problems problems = random_problems(40, 120, 25, 1, 2);
  const SparseSolution solution =
      solve_sparse(problems.dictionary, problems.as(Loss::squares), exact);
  const MatrixXd d = matrix_of(problems.dictionary);
  for (std::size_t s = 0; s < problems.count(); ++s) {
    const VectorXd code = code_of(solution, problems, s);
    const VectorXd left = problems.signal(s) - d * code;
    const VectorXd slopes = 2 * d.transpose() * problems.weight(s).cwiseProduct(left);
    const double lambda = problems.lambdas[s];
    for (Index k = 0; k < code.size(); ++k) {
      EXPECT_LE(std::abs(slopes(k)), lambda * (1 + 1e-3));
      if (std::abs(code(k)) > 1e-3) {
        EXPECT_NEAR(slopes(k), code(k) > 0 ? lambda : -lambda, 1e-3 * lambda);
      }
    }
  }
}

TEST(DualSolver, FindsTheAbsoluteMinimumOfAllCorners) {
  for (std::uint64_t seed = 3; seed < 9; ++seed) {
    const Problems problems = random_problems(7, 4, 6, 0.7, seed);
    const SparseSolution solution =
        solve_sparse(problems.dictionary, problems.as(Loss::absolute), near);
    for (std::size_t s = 0; s < problems.count(); ++s) {
      const double least = by_corners(problems, s);
      EXPECT_NEAR(objective(problems, s, Loss::absolute, code_of(solution, problems, s)), least,
                  2e-5 * least);
    }
  }
}

TEST(DualSolver, BoundsHowFarAnObjectiveIsAboveItsMinimum) {
  const Problems problems = random_problems(30, 90, 12, 0.8, 10);
  for (const Loss loss : {Loss::squares, Loss::absolute}) {
    const SparseSolution best =
        solve_sparse(problems.dictionary, problems.as(loss), loss == Loss::squares ? exact : near);
    const SparseSolution rough = solve_sparse(problems.dictionary, problems.as(loss),
                                              {.tolerance = 1e-2, .iterations = 10000});
    for (std::size_t s = 0; s < problems.count(); ++s) {
      const double found = objective(problems, s, loss, code_of(rough, problems, s));
      const double least = objective(problems, s, loss, code_of(best, problems, s));
      EXPECT_NEAR(rough.objectives[s], found, 1e-9 * found);
      EXPECT_GE(rough.gaps[s] + 1e-9 * least, found - least);
      EXPECT_LE(rough.gaps[s], 1e-2 * found * (1 + 1e-9));
      EXPECT_LE(best.gaps[s], (loss == Loss::squares ? 1e-8 : 1e-2) * least);
    }
  }
}

TEST(DualSolver, PaysNoHeedToMissingRows) {
  Problems problems = random_problems(20, 50, 10, 0.5, 11);
  const SparseSolution before =
      solve_sparse(problems.dictionary, problems.as(Loss::absolute), near);
  for (std::size_t i = 0; i < problems.signals.size(); ++i) {
    if (problems.weights[i] == 0) problems.signals[i] += 5;
  }
  const SparseSolution after = solve_sparse(problems.dictionary, problems.as(Loss::absolute), near);
  for (std::size_t s = 0; s < problems.count(); ++s)
    EXPECT_NEAR(before.objectives[s], after.objectives[s], 1e-3 * before.objectives[s]);
}

TEST(DualSolver, KeepsASpikeOutOfTheAbsoluteFitButNotOutOfTheSquares) {
  const Dictionary dictionary = random_dictionary(60, 80, 12);
  std::vector<double> clean(60), signal(60);
  for (std::size_t r = 0; r < 60; ++r)
    clean[r] = signal[r] = 4 * dictionary.atom(7)[r] - 3 * dictionary.atom(20)[r];
  signal[13] += 10;
  const std::vector<double> lambda{0.3};
  const auto distance = [&](Loss loss) {
    const SparseSolution solution = solve_sparse(dictionary, {loss, signal, {}, lambda, {}}, exact);
    double sum = 0;
    for (std::size_t r = 0; r < 60; ++r)
      sum += (solution.reconstructed[r] - clean[r]) * (solution.reconstructed[r] - clean[r]);
    return std::sqrt(sum);
  };
  EXPECT_LT(distance(Loss::absolute), 1e-3);
  EXPECT_GT(distance(Loss::squares), 1);
}

TEST(DualSolver, GivesTheSameMinimumInBatchesOfAnySizeAndFromAnyStart) {
  const Problems problems = random_problems(25, 70, 20, 0.6, 13);
  SparseProblem problem = problems.as(Loss::squares);
  const SparseSolution one = solve_sparse(problems.dictionary, problem, exact);
  DualSettings single = exact;
  single.batch = 1;
  single.first_atoms = 1;
  single.rounds = 100;
  const SparseSolution alone = solve_sparse(problems.dictionary, problem, single);
  std::vector<double> start(20 * 70, 0);
  for (std::size_t i = 0; i < start.size(); i += 7) start[i] = 1;
  problem.start = start;
  const SparseSolution warm = solve_sparse(problems.dictionary, problem, exact);
  for (std::size_t s = 0; s < problems.count(); ++s) {
    EXPECT_NEAR(alone.objectives[s], one.objectives[s], 1e-7 * one.objectives[s]);
    EXPECT_NEAR(warm.objectives[s], one.objectives[s], 1e-7 * one.objectives[s]);
  }
}

TEST(DualSolver, CodesZeroWhereTheWeightOfSparsityIsLarge) {
  Problems problems = random_problems(12, 30, 5, 1e4, 14);
  for (const Loss loss : {Loss::squares, Loss::absolute}) {
    const SparseSolution solution = solve_sparse(problems.dictionary, problems.as(loss), exact);
    ASSERT_FALSE(solution.codes.empty());
    for (const double code : solution.codes) EXPECT_NEAR(code, 0, 1e-9);
  }
}

TEST(DualSolver, TakesSignalsOfZerosAndOfNothingButGaps) {
  const Dictionary dictionary = random_dictionary(10, 20, 15);
  const std::vector<double> signals(20, 0.0), lambdas(2, 1.0);
  std::vector<double> weights(20, 1.0);
  std::fill(weights.begin() + 10, weights.end(), 0.0);
  for (const Loss loss : {Loss::squares, Loss::absolute}) {
    const SparseSolution solution = solve_sparse(dictionary, {loss, signals, weights, lambdas, {}});
    for (const double value : solution.reconstructed) EXPECT_EQ(value, 0);
  }
  EXPECT_TRUE(solve_sparse(dictionary, {}).codes.empty());
}

}  // namespace
}  // namespace kinemend::sparse
