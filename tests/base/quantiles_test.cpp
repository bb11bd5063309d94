// Tests of quantiles, against sorted values and the normal distribution.
#include "base/quantiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

std::vector<double> some_values(std::size_t count, Random& random) {
  std::vector<double> values(count);
  for (double& value : values) value = static_cast<double>(random.below(30));  // some are equal
  return values;
}

TEST(Quantiles, AreWhatStandsAtTheirPlaceInOrder) {
  Random random(1);
  for (std::size_t count = 1; count < 60; ++count) {
    const std::vector<double> values = some_values(count, random);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t rank = 0; rank < count; ++rank) {
      std::vector<double> copy = values;
      EXPECT_EQ(of_rank(copy, rank), sorted[rank]);
      const auto middle = copy.begin() + static_cast<std::ptrdiff_t>(rank);
      EXPECT_LE(*std::max_element(copy.begin(), middle + 1), sorted[rank]);
      EXPECT_GE(*std::min_element(middle, copy.end()), sorted[rank]);
    }
    for (const double share : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
      std::vector<double> copy = values;
      EXPECT_EQ(quantile_of(copy, share),
                sorted[static_cast<std::size_t>(share * static_cast<double>(count - 1))]);
    }
    std::vector<double> copy = values;
    EXPECT_EQ(median_of(copy), sorted[(count - 1) / 2]);
    EXPECT_EQ(upper_median_of(copy), sorted[count / 2]);
  }
  std::vector<double> none;
  EXPECT_EQ(quantile_of(none, 0.3), 0);
  EXPECT_EQ(median_of(none), 0);
  EXPECT_EQ(upper_median_of(none), 0);
}

TEST(Quantiles, OfNormalNumbersAreThoseOfTheirDistributions) {
  // P(|x| < m), and P(|v| < m) for v of three components.
  const auto within = [](double m) { return std::erf(m / std::sqrt(2.0)); };
  const auto within_3 = [&](double m) {
    return within(m) - std::sqrt(2 / 3.14159265358979323846) * m * std::exp(-m * m / 2);
  };
  EXPECT_NEAR(within(1 / deviations_per_median), 0.5, 1e-15);
  EXPECT_NEAR(within_3(median_of_chi3), 0.5, 1e-15);
}

}  // namespace
}  // namespace kinemend
