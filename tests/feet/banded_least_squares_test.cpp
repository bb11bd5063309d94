// Tests of the banded least-squares solver, against a dense one.
#include "feet/banded_least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "dense_algebra.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::feet {
namespace {

using Term = BandedLeastSquares::Term;

// Adds squares that each combine `count` neighbours, and compares with a dense solver.
template <std::size_t count>
void compare_with_dense_solver() {
  constexpr std::size_t size = 40, squares = 150;
  Random random(12);
  BandedLeastSquares system(size, count - 1);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(squares + size, size);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(squares + size);
  const auto add = [&](std::size_t row, const auto& terms, double value, double weight) {
    system.add(terms, value, weight);
    const auto r = static_cast<Eigen::Index>(row);
    for (const Term& term : terms)
      rows(r, static_cast<Eigen::Index>(term.unknown)) += std::sqrt(weight) * term.factor;
    values[r] = std::sqrt(weight) * value;
  };
  for (std::size_t i = 0; i < squares; ++i) {
    const auto first =
        static_cast<std::size_t>(random.uniform(0, static_cast<double>(size - count + 1)));
    std::array<Term, count> terms;
    for (std::size_t j = 0; j < count; ++j) terms[j] = {first + j, random.normal()};
    if (i % 10 == 0) terms[count - 1] = {0, 0};
    add(i, terms, random.normal(), random.uniform(0.1, 10));
  }
  for (std::size_t i = 0; i < size; ++i) add(squares + i, std::array<Term, 1>{{{i, 1}}}, 0, 0.01);
  const Eigen::VectorXd expected = test::least_squares(rows, -values);
  const std::vector<double> found = system.solve();
  ASSERT_EQ(found.size(), size);
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_NEAR(found[i], expected[static_cast<Eigen::Index>(i)], 1e-9) << count << " terms";
}

TEST(BandedLeastSquares, FindsWhatADenseSolverFinds) {
  compare_with_dense_solver<1>();
  compare_with_dense_solver<2>();
  compare_with_dense_solver<4>();
  compare_with_dense_solver<9>();
}

TEST(BandedLeastSquares, DrawsTheStraightLineOfLeastCurvature) {
  constexpr std::size_t size = 21;
  BandedLeastSquares system(size, 2);
  for (std::size_t i = 0; i + 2 < size; ++i)
    system.add(std::array<Term, 3>{{{i, 1}, {i + 1, -2}, {i + 2, 1}}}, 0, 1);
  system.add(std::array<Term, 1>{{{0, 1}}}, -3, 1e6);        // x = 3
  system.add(std::array<Term, 1>{{{size - 1, 1}}}, 5, 1e6);  // x = -5
  const std::vector<double> line = system.solve();
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_NEAR(line[i], 3 - 8.0 * static_cast<double>(i) / 20, 1e-6);
}

}  // namespace
}  // namespace kinemend::feet
