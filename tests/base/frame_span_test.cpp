// Tests of runs of frames, of seconds as frames, and of fades.
#include "base/frame_span.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace kinemend {
namespace {

std::vector<FrameSpan> runs_of(const std::vector<std::uint8_t>& flags) {
  return runs_where(flags.size(), [&](std::size_t f) { return flags[f] != 0; });
}

TEST(RunsOfFrames, AreAsLongAsTheFlagHolds) {
  const std::vector<FrameSpan> runs = runs_of({1, 0, 1, 1, 1, 0, 0, 1, 1});
  ASSERT_EQ(runs.size(), 3u);
  const std::array<std::size_t, 3> firsts{0, 2, 7}, lasts{0, 4, 8};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(runs[i].first, firsts[i]);
    EXPECT_EQ(runs[i].last, lasts[i]);
    EXPECT_EQ(runs[i].length(), lasts[i] - firsts[i] + 1);
  }
}

TEST(RunsOfFrames, MayBeNoneOrOne) {
  EXPECT_TRUE(runs_of({}).empty());
  EXPECT_TRUE(runs_of({0, 0, 0}).empty());
  ASSERT_EQ(runs_of({1, 1, 1}).size(), 1u);
  EXPECT_EQ(runs_of({1, 1, 1})[0].length(), 3u);
}

TEST(RunsOfFrames, GoOnAcrossShortBreaks) {
  const std::vector<std::uint8_t> flags{0, 1, 0, 1, 0, 0, 1, 0, 0, 0, 1};
  const auto runs = runs_where(
      flags.size(), [&](std::size_t f) { return flags[f] != 0; }, 2);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].first, 1u);
  EXPECT_EQ(runs[0].last, 6u);
  EXPECT_EQ(runs[1].first, 10u);
  EXPECT_EQ(runs[1].last, 10u);
}

TEST(Bridges, AreStraightBetweenKnownSamplesAndLevelAtTheEnds) {
  const auto bridged = [](std::vector<double> values, const std::vector<std::uint8_t>& known) {
    bridge(
        values.size(), [&](std::size_t f) { return known[f] != 0; },
        [&](std::size_t f) -> double& { return values[f]; });
    return values;
  };
  EXPECT_EQ(bridged({9, 9, 1, 9, 9, 9, 3, 9}, {0, 0, 1, 0, 0, 0, 1, 0}),
            (std::vector<double>{1, 1, 1, 1.5, 2, 2.5, 3, 3}));
  EXPECT_EQ(bridged({1, 2}, {0, 0}), (std::vector<double>{1, 2}));
}

TEST(SomeFrames, AreSpreadEvenly) {
  EXPECT_EQ(evenly_spread(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(evenly_spread(10, 4), (std::vector<std::size_t>{0, 2, 5, 7}));
  EXPECT_TRUE(evenly_spread(0, 4).empty());
}

TEST(FramesInSeconds, AreRoundedAndNotBelowTheLeast) {
  EXPECT_EQ(frames_in(0.5, 60, 0), 30u);
  EXPECT_EQ(frames_in(0.02, 60, 0), 1u);
  EXPECT_EQ(frames_in(0.025, 60, 0), 2u);  // 1.5
  EXPECT_EQ(frames_in(0.001, 60, 0), 0u);
  EXPECT_EQ(frames_in(0.001, 60, 2), 2u);
  EXPECT_EQ(frames_in(1e9, 60, 0), 1'000'000'000u);
}

TEST(SmoothStep, RisesFromZeroToOneAndIsLevelAtBothEnds) {
  EXPECT_EQ(smooth_step(0), 0);
  EXPECT_EQ(smooth_step(0.25), 0.15625);
  EXPECT_EQ(smooth_step(0.5), 0.5);
  EXPECT_EQ(smooth_step(1), 1);
  EXPECT_LT(smooth_step(1e-4), 1e-7);
  EXPECT_GT(smooth_step(1 - 1e-4), 1 - 1e-7);
}

}  // namespace
}  // namespace kinemend
