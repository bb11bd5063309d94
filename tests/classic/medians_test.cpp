// Tests of medoids and medians of rotations and points, by brute force.
#include "classic/medians.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/extend/random.hpp"

namespace kinemend::test {
namespace {

std::vector<Quat> scattered(std::size_t count, double size, Random& random) {
  std::vector<Quat> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    samples.push_back(exp({0.4, 2.5, -0.2}) * exp({size * x, size * y, size * z}));
    if (random.chance(0.5)) samples.back() = -samples.back();
  }
  return samples;
}

double sum_of_chords(std::span<const Quat> samples, Quat point) {
  double sum = 0;
  for (const Quat& q : samples) sum += 4 * std::sin(angle_between(q, point) / 4);
  return sum;
}

TEST(Medians, AChordIsTheAngleForSmallTurnsAndKnowsNoSigns) {
  EXPECT_NEAR(chord(exp({0.01, 0, 0}), exp({0.03, 0, 0})), 0.02, 1e-6);
  EXPECT_NEAR(chord({1, 0, 0, 0}, {-1, 0, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(chord(exp({1, 0, 0}), -exp({0, 1, 0})),
              4 * std::sin(angle_between(exp({1, 0, 0}), exp({0, 1, 0})) / 4), 1e-12);
}

TEST(Medians, TheMedoidHasTheLeastSumOfAllSamples) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const auto samples = scattered(3 + random.below(20), 0.5, random);
    const double found = sum_of_chords(samples, samples[medoid(samples)]);
    for (const Quat& q : samples) EXPECT_LE(found, sum_of_chords(samples, q) + 1e-12);
  }
}

TEST(Medians, AMedoidIsTheSameWithMemoryThatIsUsedAgain) {
  Random random(6);
  std::vector<double> scratch;
  for (int trial = 0; trial < 50; ++trial) {
    const auto samples = scattered(1 + random.below(20), 0.5, random);
    EXPECT_EQ(medoid(samples, scratch), medoid(samples));
    std::vector<Vec3> points;
    for (const Quat& q : samples) points.push_back(log(q));
    EXPECT_EQ(medoid(points, scratch), medoid(points));
  }
}

TEST(Medians, AMovingMedoidIsThatOfEachWindow) {
  Random random(2);
  const auto track = scattered(80, 0.3, random);
  MovingMedoid<Quat> moving(track, 11);
  for (std::size_t t = 0; t < 80; ++t) {
    const std::size_t first = t - std::min<std::size_t>(t, 5),
                      last = std::min<std::size_t>(79, t + 5);
    const auto window = std::span<const Quat>(track).subspan(first, last - first + 1);
    const std::size_t found = moving.find(first, last);
    EXPECT_EQ(found, first + medoid(window)) << t;
    for (std::size_t f = first; f <= last; ++f) {
      EXPECT_NEAR(moving.distance(found, f), chord(track[found], track[f]), 1e-15);
    }
  }
}

TEST(Medians, NoPointNearbyHasASmallerSumThanTheMedian) {
  Random random(3);
  std::vector<Vec3> scratch;
  for (int trial = 0; trial < 50; ++trial) {
    const auto samples = scattered(3 + random.below(12), 0.1, random);
    const Quat median = l1_median(samples, medoid(samples), scratch);
    const double found = sum_of_chords(samples, median);
    for (int probe = 0; probe < 50; ++probe) {
      const double size = 0.1 * random.uniform();
      const Vec3 step{size * random.normal(), size * random.normal(), size * random.normal()};
      EXPECT_LE(found, sum_of_chords(samples, median * exp(step)) + 1e-5);
    }
  }
}

TEST(Medians, AMajorityInOnePlaceIsTheMedian) {
  std::vector<Vec3> scratch;
  const Quat q = exp({0.1, 0.2, 0.3});
  const std::vector<Quat> samples{q, exp({2, 0, 0}), -q, q, exp({0, -1, 0})};
  EXPECT_LT(angle_between(l1_median(samples, medoid(samples), scratch), q), 1e-12);
}

TEST(Medians, ThreePointsOnACircleHaveTheirMedianInTheMiddle) {
  std::vector<Vec3> scratch;
  const std::vector<Vec3> samples{
      {1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}};
  EXPECT_LT(norm(l1_median(samples, medoid(samples), scratch)), 1e-3);
}

TEST(Medians, AreTheSameInAnyCoordinateFrame) {
  Random random(4);
  std::vector<Vec3> scratch;
  const Quat left = exp({1, 2, 0.5}), right = exp({-0.3, 1, 1});
  const auto samples = scattered(9, 0.2, random);
  std::vector<Quat> turned;
  for (const Quat& q : samples) turned.push_back(left * q * right);
  const Quat a = l1_median(samples, medoid(samples), scratch);
  const Quat b = l1_median(turned, medoid(turned), scratch);
  EXPECT_LT(angle_between(left * a * right, b), 1e-9);
}

}  // namespace
}  // namespace kinemend::test
