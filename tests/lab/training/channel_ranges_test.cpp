// Tests of the quantiles of channels over many takes.
#include "lab/training/channel_ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

TEST(ChannelRanges, KnowTheQuantilesToAQuarterDegree) {
  Random random(1);
  PoseMatrix poses(20000, 2);
  for (std::size_t f = 0; f < poses.frames; ++f) {
    poses(f, 0) = 40 * random.uniform() - 10;
    poses(f, 1) = 5 * random.normal();
  }
  ChannelRanges ranges(2);
  ranges.add(poses);
  for (const double share : {0.001, 0.1, 0.5, 0.999}) {
    EXPECT_NEAR(ranges.quantile(0, share), 40 * share - 10, 0.7);
  }
  EXPECT_NEAR(ranges.quantile(1, 0.8413447), 5, 0.3);
  EXPECT_NEAR(ranges.quantile(1, 0.5), 0, 0.3);
}

TEST(ChannelRanges, CountWeightsAsRepetitions) {
  PoseMatrix low(10, 1, -3.0), high(10, 1, 8.0);
  ChannelRanges ranges(1);
  ranges.add(low, 0.5);
  ranges.add(high, 0.1);
  EXPECT_NEAR(ranges.quantile(0, 0.8), -3, 0.25);
  EXPECT_NEAR(ranges.quantile(0, 0.9), 8, 0.25);
  EXPECT_NEAR(ranges.quantile(0, 0), -3, 0.25);
  EXPECT_NEAR(ranges.quantile(0, 1), 8, 0.25 + 1e-9);
}

TEST(ChannelRanges, OfNothingAreZero) { EXPECT_EQ(ChannelRanges(3).quantile(2, 0.5), 0); }

}  // namespace
}  // namespace kinemend
