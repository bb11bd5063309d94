// Tests of the limit on how far a learned model may change a part of a take.
#include "methods/prior/prior_fall_backs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace kinemend {
namespace {

constexpr std::size_t frames = 200;

// A take of one part: `auto` gives zero, the filter a jump of this size at frame 10, and the noise
// is one degree per axis.
PriorWork leaping(double size) {
  PriorWork work;
  work.channels.poses = PoseMatrix(frames, 3);
  work.fallback = PoseMatrix(frames, 3);
  work.channels.observed.assign(frames * 3, 1);
  work.suspect.assign(frames * 3, 0);
  work.noise.assign(3, 1);
  work.needs = {1};
  work.channels.poses(10, 0) = size;
  return work;
}

double leap(const PriorWork& work, std::size_t frame = 10) {
  const PoseMatrix& poses = work.channels.poses;
  return std::hypot(poses(frame, 0), poses(frame, 1), poses(frame, 2));
}

TEST(HoldToNeeds, PutsASampleNoFartherFromAutosThanTheNoiseIsStrong) {
  PriorWork work = leaping(20);
  work.channels.poses(10, 1) = -15;
  hold_to_needs(work);
  EXPECT_NEAR(leap(work), std::sqrt(3), 1e-12);
  EXPECT_NEAR(work.channels.poses(10, 1) / work.channels.poses(10, 0), -0.75, 1e-12);
  ASSERT_EQ(work.fall_backs.size(), 2u);
  EXPECT_NEAR(work.fall_backs[1].shares[0], (1 - std::sqrt(3) / 25) / frames, 1e-12);
}

TEST(HoldToNeeds, LeavesWhatIsWithinTheNoiseToTheBit) {
  PriorWork work = leaping(1.7);
  const std::vector<double> before = work.channels.poses.values;
  hold_to_needs(work);
  EXPECT_EQ(work.channels.poses.values, before);
}

TEST(HoldToNeeds, LetsASpikeGoAsFarAsItMust) {
  PriorWork work = leaping(20);
  work.suspect[3 * 10] = 1;
  hold_to_needs(work);
  EXPECT_EQ(leap(work), 20);
}

TEST(SuspectShare, CountsWhatIsFarFromAResultAndWhatAutoSuspects) {
  PriorWork work = leaping(0);
  EXPECT_EQ(suspect_share(work, work.fallback), 0);
  for (std::size_t f = 0; f < 20; ++f) work.channels.poses(7 * f, 2) += 60;
  EXPECT_NEAR(suspect_share(work, work.fallback), 20.0 / (frames * 3), 1e-12);
  for (std::size_t f = 0; f < 40; ++f) work.suspect[f * 3] = 1;
  EXPECT_NEAR(suspect_share(work, work.fallback), 60.0 / (frames * 3), 1e-12);
}

// `auto` may mistake this many outliers for noise and suspect none of them.
TEST(HoldToNeeds, DoesNotHoldWhereManySamplesAreFarFromAutos) {
  for (const auto& [outliers, farthest] : {std::pair{10, std::sqrt(3)}, {14, 20.0}}) {
    PriorWork work = leaping(0);
    for (int i = 0; i < outliers; ++i)
      work.channels.poses(11 * static_cast<std::size_t>(i), 1) = 60;
    settle_needs(work, PriorHold::noise);
    work.channels.poses = PoseMatrix(frames, 3);
    work.channels.poses(10, 0) = 20;
    hold_to_needs(work);
    EXPECT_NEAR(leap(work), farthest, 1e-12) << outliers;
  }
}

TEST(HoldToNeeds, DoesNotHoldAFilterThatFindsMoreThanOneOutlierInFifty) {
  for (const auto& [outliers, farthest] : {std::pair{0.019, std::sqrt(3)}, {0.021, 20.0}}) {
    PriorWork work = leaping(20);
    settle_needs(work, PriorHold::white_noise);
    release_if_crowded(work, outliers);
    hold_to_needs(work);
    EXPECT_NEAR(leap(work), farthest, 1e-12) << outliers;
  }
}

TEST(HoldToNeeds, LeavesAPartThatNeedsNothingToAutoEvenThen) {
  PriorWork work = leaping(20);
  work.needs = {0};
  release_if_crowded(work, 0.2);
  hold_to_needs(work);
  EXPECT_EQ(leap(work), 0);
}

TEST(HoldToNeeds, DoesNotHoldAFilterThatIsToldWhatToDo) {
  PriorWork work = leaping(20);
  work.needs = {0.5};
  settle_needs(work, PriorHold::nothing);
  hold_to_needs(work);
  EXPECT_EQ(leap(work), 20);
}

TEST(HoldToNeeds, DoesNotHoldTheFilterWhereOneSampleInFiftyIsASpike) {
  PriorWork work = leaping(20);
  work.needs = {0};
  for (std::size_t f = 100; f < 105; ++f) work.suspect[3 * f] = 1;
  settle_needs(work, PriorHold::white_noise);
  EXPECT_EQ(work.needs[0], 0) << "5 of 600";
  for (std::size_t f = 100; f < 105; ++f) work.suspect[3 * f + 1] = work.suspect[3 * f + 2] = 1;
  work.is_white = false;
  settle_needs(work, PriorHold::white_noise);
  hold_to_needs(work);
  EXPECT_EQ(leap(work), 20);
}

TEST(HoldToNeeds, LeavesNoiseWithAColourToAutoWhereTheFilterTakesItForWhite) {
  PriorWork work = leaping(1);
  settle_needs(work, PriorHold::white_noise);
  EXPECT_EQ(work.needs[0], 1);
  work.is_white = false;
  settle_needs(work, PriorHold::noise);
  EXPECT_EQ(work.needs[0], 1);
  settle_needs(work, PriorHold::white_noise);
  EXPECT_EQ(work.needs[0], 0);
}

TEST(HoldToNeeds, MovesWhatFillsAGapWithTheSamplesBesideIt) {
  PriorWork work = leaping(20);
  for (std::size_t f = 11; f <= 13; ++f) {
    for (std::size_t c = 0; c < 3; ++c) work.channels.observed[3 * f + c] = 0;
    work.channels.poses(f, 0) = 20;
  }
  work.channels.poses(14, 0) = 20;
  hold_to_needs(work);
  for (std::size_t f = 10; f <= 14; ++f) EXPECT_NEAR(leap(work, f), std::sqrt(3), 1e-12) << f;
}

TEST(HoldToNeeds, GivesAPartThatNeedsNothingBackToAuto) {
  PriorWork work = leaping(20);
  work.needs = {0};
  hold_to_needs(work);
  EXPECT_EQ(leap(work), 0);
  EXPECT_EQ(work.fall_backs[0].shares[0], 1) << "and not a word of how far the filter went";
}

}  // namespace
}  // namespace kinemend
