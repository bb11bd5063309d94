// Tests of the random numbers: the sequence of the published generator, moments, and independent
// forks.
#include "kinemend/extend/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "base/csv.hpp"

namespace kinemend {
namespace {

TEST(Random, GivesTheNumbersOfXoshiro256PlusPlus) {
  const auto rows = test::read_csv("base/xoshiro256pp.csv");
  ASSERT_EQ(rows.size(), 28u);
  for (const auto& row : rows) {
    Random random(std::stoull(row[0]));
    std::uint64_t value = random.next();
    for (unsigned long skipped = std::stoul(row[1]); skipped > 0; --skipped) value = random.next();
    EXPECT_EQ(value, std::stoull(row[2])) << "seed " << row[0] << ", position " << row[1];
  }
}

TEST(Random, IsUniformInUnitInterval) {
  Random random(1);
  double sum = 0, square = 0, low = 1, high = 0;
  constexpr int count = 100000;
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u / count;
    square += u * u / count;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  EXPECT_NEAR(sum, 0.5, 0.004);
  EXPECT_NEAR(square - sum * sum, 1.0 / 12, 0.001);
  EXPECT_LT(low, 1e-3);
  EXPECT_GT(high, 1 - 1e-3);
}

TEST(Random, IsUniformBetweenBounds) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(-3, 5);
    EXPECT_GE(u, -3);
    EXPECT_LT(u, 5);
  }
}

TEST(Random, NormalHasTheMomentsOfTheStandardNormal) {
  Random random(3);
  constexpr int count = 200000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  int beyond_two = 0;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal();
    m1 += x / count;
    m2 += x * x / count;
    m3 += x * x * x / count;
    m4 += x * x * x * x / count;
    beyond_two += std::fabs(x) > 2;
  }
  EXPECT_NEAR(m1, 0, 0.01);
  EXPECT_NEAR(m2, 1, 0.015);
  EXPECT_NEAR(m3, 0, 0.04);
  EXPECT_NEAR(m4, 3, 0.12);
  EXPECT_NEAR(beyond_two / static_cast<double>(count), 0.0455, 0.002);
}

TEST(Random, BelowGivesEachValueEquallyOften) {
  Random random(4);
  std::vector<int> counts(7, 0);
  for (int i = 0; i < 70000; ++i) ++counts.at(random.below(7));
  for (const int count : counts) EXPECT_NEAR(count, 10000, 400);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random.below(1), 0u);
}

TEST(Random, BelowOfAHugeCountIsNotSkewed) {
  // 3/4 of the range: taking the remainder alone would give the lowest third twice as often.
  Random random(5);
  const std::uint64_t count = (std::uint64_t{1} << 63) + (std::uint64_t{1} << 62);
  int low = 0;
  for (int i = 0; i < 10000; ++i) low += random.below(count) < count / 3;
  EXPECT_NEAR(low, 3333, 200);
}

TEST(Random, ChanceHasItsProbability) {
  Random random(6);
  int hits = 0;
  for (int i = 0; i < 100000; ++i) hits += random.chance(0.1);
  EXPECT_NEAR(hits, 10000, 400);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(random.chance(0));
    EXPECT_TRUE(random.chance(1));
  }
}

TEST(Random, ForksAreRepeatableDifferentAndLeaveTheParentAlone) {
  const Random parent(7);
  Random before = parent, after = parent;
  std::set<std::uint64_t> firsts;
  for (std::uint64_t index = 0; index < 1000; ++index) {
    Random once = parent.fork(index), again = parent.fork(index);
    const std::uint64_t first = once.next();
    EXPECT_EQ(first, again.next());
    EXPECT_TRUE(firsts.insert(first).second) << index;
  }
  for (int i = 0; i < 10; ++i) EXPECT_EQ(before.next(), after.next());
  EXPECT_NE(Random(7).fork(0).next(), Random(8).fork(0).next());
}

TEST(Random, NeighbouringForksAreUncorrelated) {
  const Random parent(8);
  double product = 0;
  for (std::uint64_t index = 0; index < 20000; ++index) {
    product += parent.fork(index).normal() * parent.fork(index + 1).normal() / 20000;
  }
  EXPECT_NEAR(product, 0, 0.03);
}

TEST(NormalQuantile, AgreesWithScipy) {
  const auto rows = test::read_csv("base/normal_quantile.csv");
  ASSERT_GT(rows.size(), 100u);
  for (const auto& row : rows) {
    const double p = std::stod(row[0]), expected = std::stod(row[1]);
    EXPECT_NEAR(normal_quantile(p), expected, 3e-15 * std::max(1.0, std::fabs(expected))) << row[0];
  }
}

TEST(NormalQuantile, InvertsTheDistributionFunction) {
  for (double x = -8; x <= 5; x += 0.125) {
    const double p = 0.5 * std::erfc(-x / std::sqrt(2.0));
    // Rounding changes p by a step; dividing by the density converts it to a step in x.
    const double density = std::exp(-x * x / 2) / std::sqrt(2 * 3.14159265358979323846);
    EXPECT_NEAR(normal_quantile(p), x, 1e-14 + 1e-15 * p / density);
  }
}

}  // namespace
}  // namespace kinemend
