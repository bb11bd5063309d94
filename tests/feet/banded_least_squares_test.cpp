#include "feet/banded_least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "kinemend/random.hpp"

namespace kinemend::feet {
namespace {

TEST(BandedLeastSquares, FindsWhatADenseSolverFinds) {
  Random random(12);
  for (const std::size_t band : {0u, 1u, 3u, 8u}) {
    constexpr std::size_t size = 40, squares = 150;
    BandedLeastSquares system(size, band);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(squares + size, size);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(squares + size);
    const auto add = [&](std::size_t row, std::vector<BandedLeastSquares::Term> terms, double value,
                         double weight) {
      system.add(terms, value, weight);
      const auto r = static_cast<Eigen::Index>(row);
      for (const auto& term : terms)
        rows(r, static_cast<Eigen::Index>(term.unknown)) = std::sqrt(weight) * term.factor;
      values[r] = std::sqrt(weight) * value;
    };
    for (std::size_t i = 0; i < squares; ++i) {
      const auto first =
          static_cast<std::size_t>(random.uniform(0, static_cast<double>(size - band)));
      std::vector<BandedLeastSquares::Term> terms;
      for (std::size_t j = band + 1; j-- > 0;) terms.push_back({first + j, random.normal()});
      add(i, terms, random.normal(), random.uniform(0.1, 10));
    }
    for (std::size_t i = 0; i < size; ++i) add(squares + i, {{i, 1}}, 0, 0.01);
    const Eigen::VectorXd expected = rows.colPivHouseholderQr().solve(-values);
    const std::vector<double> found = system.solve();
    ASSERT_EQ(found.size(), size);
    for (std::size_t i = 0; i < size; ++i)
      EXPECT_NEAR(found[i], expected[static_cast<Eigen::Index>(i)], 1e-9) << "band " << band;
  }
}

TEST(BandedLeastSquares, DrawsTheStraightLineOfLeastCurvature) {
  constexpr std::size_t size = 21;
  BandedLeastSquares system(size, 2);
  using Term = BandedLeastSquares::Term;
  for (std::size_t i = 0; i + 2 < size; ++i)
    system.add(std::vector<Term>{{i, 1}, {i + 1, -2}, {i + 2, 1}}, 0, 1);
  system.add(std::vector<Term>{{0, 1}}, -3, 1e6);        // x = 3
  system.add(std::vector<Term>{{size - 1, 1}}, 5, 1e6);  // x = -5
  const std::vector<double> line = system.solve();
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_NEAR(line[i], 3 - 8.0 * static_cast<double>(i) / 20, 1e-6);
}

}  // namespace
}  // namespace kinemend::feet
