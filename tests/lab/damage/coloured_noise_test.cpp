// Tests of coloured noise: its spectrum follows the formula and does not depend on the rate.
#include "lab/damage/coloured_noise.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "noise_measures.hpp"

namespace kinemend::corrupt {
namespace {

constexpr NoiseShape shapes[] = {{0.5, 2}, {1.2, 3.3}, {3, 2.5}, {9, 4}, {40, 4}};

TEST(ColouredNoise, HasADensityWhoseIntegralIsOne) {
  for (const NoiseShape shape : shapes) {
    double sum = 0;
    constexpr double step = 0.001, end = 3000;
    for (double f = step / 2; f < end; f += step) sum += step * noise_density(shape, f);
    // Adds the integral of the tail (f / corner)^-slope.
    sum += noise_density(shape, end) * end / (shape.slope - 1);
    EXPECT_NEAR(sum, 1, 1e-4) << shape.corner_hz << " " << shape.slope;
  }
}

TEST(ColouredNoise, HasTheSpectrumOfItsFormula) {
  for (const NoiseShape shape : shapes) {
    // 2,000 s in segments of 8 s: each value has a deviation of about 5 %, the mean of nine bands 2
    // %.
    const auto noise = coloured_noise(shape, 60000, 60, Random(3));
    const auto found = test::welch(noise, 60, 480);
    for (const auto& [low, high] : {std::pair{0.5, 1.0}, {1, 2}, {2, 6}, {6, 15}, {15, 28}}) {
      double expected = 0;
      for (double f = low; f < high; f += found.step_hz)
        expected += found.step_hz * noise_density(shape, f);
      // 250 segments: each value has a deviation of 7 %, the mean of the first band's four 4 %.
      EXPECT_NEAR(found.between(low, high) / expected, 1, 0.12)
          << shape.corner_hz << " " << shape.slope << " from " << low;
    }
  }
}

TEST(ColouredNoise, HasTheAutocorrelationOfAnExponentialWhereItsSlopeIsTwo) {
  // The transform of a Lorentzian is exp(-2 pi fc t), less the part above half of the rate.
  const auto noise = coloured_noise({1, 2}, 400000, 200, Random(5));
  for (const std::size_t lag : {10, 20, 50})
    EXPECT_NEAR(test::autocorrelation(noise, lag),
                std::exp(-2 * pi * static_cast<double>(lag) / 200), 0.03);
  EXPECT_NEAR(test::variance_of(noise), 1, 0.05);
}

TEST(ColouredNoise, IsTheSameMotionAtTwiceTheRate) {
  // The higher rate adds only frequencies above half of the lower rate.
  const NoiseShape shape{1, 6};
  const auto slow = coloured_noise(shape, 600, 60, Random(7)),
             fast = coloured_noise(shape, 1200, 120, Random(7));
  for (std::size_t f = 0; f < slow.size(); ++f) EXPECT_NEAR(slow[f], fast[2 * f], 1e-3) << f;
}

TEST(ColouredNoise, HasTheSameDensityAtAnyRate) {
  const NoiseShape shape{12, 4};
  const auto noise = coloured_noise(shape, 60000, 60, Random(8)),
             other = coloured_noise(shape, 100000, 100, Random(9));
  const auto a = test::welch(noise, 60, 480), b = test::welch(other, 100, 800);
  for (const auto& [low, high] : {std::pair{1.0, 6.0}, {6, 15}, {15, 25}})
    EXPECT_NEAR(a.between(low, high) / b.between(low, high), 1, 0.08) << low;
}

TEST(ColouredNoise, DoesNotCloseTheCircle) {
  // The noise at the end of a take does not correlate with that at its beginning.
  std::vector<double> first, last;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const auto noise = coloured_noise({1, 3}, 64, 60, Random(seed));
    first.push_back(noise.front());
    last.push_back(noise.back());
  }
  // 64 frames are about one second, after which noise of 1 Hz is uncorrelated.
  EXPECT_NEAR(test::correlation_of(first, last), 0, 0.1);
  EXPECT_NEAR(test::variance_of(first), 1, 0.12);
}

TEST(ColouredNoise, TakesAnyNumberOfFrames) {
  for (const std::size_t frames : {0, 1, 2, 3, 1000})
    EXPECT_EQ(coloured_noise({1, 2}, frames, 60, Random(1)).size(), frames);
}

TEST(RandomPath, HasADeviationOfOneAfterAMinuteAndNoSteps) {
  std::vector<double> after_a_minute, after_a_quarter, steps;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto path = random_path(1801, 30, Random(seed));
    EXPECT_EQ(path[0], 0);
    after_a_minute.push_back(path[1800]);
    after_a_quarter.push_back(path[450]);
    for (std::size_t f = 1; f < 30; ++f) steps.push_back(path[f] - path[f - 1]);
  }
  EXPECT_NEAR(std::sqrt(test::variance_of(after_a_minute)), 1, 0.06);
  EXPECT_NEAR(std::sqrt(test::variance_of(after_a_quarter)), 0.5, 0.05);
  // Independent steps have 1 / sqrt(1800) = 0.024 each.
  EXPECT_LT(std::sqrt(test::variance_of(steps)), 0.008);
}

}  // namespace
}  // namespace kinemend::corrupt
