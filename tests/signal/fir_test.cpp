// Tests of the Gaussian and the weighted mean, against SciPy and Blender.
#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "signal/support.hpp"

namespace kinemend::test {
namespace {

TEST(Gaussian, GivesTheNumbersOfSciPysCorrelate1dOnAReflectedTake) {
  for (const std::string sigma : {"0.4", "1.5", "3.0", "50.0"}) {
    PoseMatrix take = column(reference().at("input/long"));
    gaussian_filter(take, std::stod(sigma));
    EXPECT_LT(largest_difference(take.values, reference().at("gaussian/" + sigma)), 1e-10) << sigma;
  }
}

TEST(Gaussian, OfWidthZeroChangesNothing) {
  const PoseMatrix input = noisy_sines(20, 3, 1);
  EXPECT_EQ(filtered(input, [](PoseMatrix& m) { gaussian_filter(m, 0); }).values, input.values);
}

TEST(Gaussian, RefusesWidthsThatMakeNoSense) {
  PoseMatrix take = noisy_sines(20, 3, 1);
  for (const double sigma : {-1.0, std::nan(""), static_cast<double>(INFINITY)}) {
    EXPECT_THROW(gaussian_filter(take, sigma), Error);
  }
}

// Smooths key by key as Blender's graph editor does, with two means weighted to the past and the
// future.
std::vector<double> smooth_keys(const std::vector<double>& x) {
  std::vector<double> y = x;
  const auto last = static_cast<int>(x.size()) - 1;
  for (int i = 1; i < last; ++i) {
    const double p1 = x[i - 1];
    const double p2 = i > 2 ? x[i - 2] : p1;
    const double n1 = x[i + 1];
    const double n2 = i + 2 <= last ? x[i + 2] : n1;
    const double past = (3 * p2 + 5 * p1 + 2 * x[i] + n1 + n2) / 12;
    const double future = (p2 + p1 + 2 * x[i] + 5 * n1 + 3 * n2) / 12;
    y[i] = (past + future) / 2;
  }
  return y;
}

TEST(WeightedMean, WithReflectedEndsDiffersFromBlenderNearTheEndsOnly) {
  const PoseMatrix input = noisy_sines(50, 1, 3, 0.5);
  PoseMatrix reflected = input;
  weighted_mean_filter(reflected, 1);
  const std::vector<double> blender = smooth_keys(input.values);
  for (const std::size_t t : {1u, 2u, 48u}) EXPECT_GT(std::abs(reflected(t, 0) - blender[t]), 1e-6);
  for (std::size_t t = 3; t < 48; ++t) EXPECT_NEAR(reflected(t, 0), blender[t], 1e-14);
  EXPECT_NEAR(reflected(0, 0), input(0, 0), 1e-14);
  EXPECT_NEAR(reflected(49, 0), input(49, 0), 1e-14);
}

TEST(WeightedMean, WithoutPassesChangesNothingAndRefusesANegativeNumber) {
  PoseMatrix take = noisy_sines(20, 3, 1);
  const PoseMatrix input = take;
  weighted_mean_filter(take, 0);
  EXPECT_EQ(take.values, input.values);
  EXPECT_THROW(weighted_mean_filter(take, -1), Error);
}

}  // namespace
}  // namespace kinemend::test
