// Tests of the kinematics of synthetic gestures and jumps.
#include <gtest/gtest.h>

#include "lab/synthesis/measure.hpp"

namespace kinemend {
namespace {

using measure::largest;
using measure::make;
using measure::speeds;
using measure::track;

TEST(Gesture, APunchIsFastAndStopsShort) {
  const Take clip = make("punch", 4, 240);
  for (const char* hand : {"LeftHand", "RightHand"}) {
    const auto speed = speeds(track(clip, hand), 240);
    const double peak = largest(speed);
    EXPECT_GT(peak, 500) << hand;
    EXPECT_LT(peak, 1100) << hand;
    const auto at =
        static_cast<std::size_t>(std::max_element(speed.begin(), speed.end()) - speed.begin());
    // 40 ms after its peak the fist has lost most of its speed.
    EXPECT_LT(speed[at + 10], 0.3 * peak) << hand;
  }
}

TEST(Gesture, AClapBringsThePalmsTogetherAndHoldsThem) {
  for (std::uint64_t seed : {1, 2, 3}) {
    const Take clip = make("clap", 4, 240, seed);
    const auto left = track(clip, "LeftHand"), right = track(clip, "RightHand");
    std::vector<double> gap;
    for (std::size_t f = 0; f < left.size(); ++f) gap.push_back(norm(left[f] - right[f]));
    const double closest = measure::least(gap);
    EXPECT_LT(closest, 4.5);
    EXPECT_GT(closest, 2);
    double closing = 0;
    for (std::size_t f = 1; f < gap.size(); ++f)
      closing = std::max(closing, (gap[f - 1] - gap[f]) * 240);
    EXPECT_GT(closing, 330);
    EXPECT_LT(closing, 600);
    // Counts contacts of 40 ms or more.
    std::size_t contacts = 0, length = 0;
    for (double g : gap) {
      length = g < closest + 0.05 ? length + 1 : 0;
      if (length == 10) ++contacts;
    }
    EXPECT_GE(contacts, 3u);
  }
}

TEST(Gesture, ALandingStopsTheFeetAtOnceAndTheBodyLater) {
  const Take clip = make("landing", 3, 480);
  const auto ball = track(clip, "LeftToeBase");
  std::vector<double> fall, foot_fall;
  for (std::size_t f = 1; f < ball.size(); ++f) {
    fall.push_back((clip.root_position(f - 1).y - clip.root_position(f).y) * 480);
    foot_fall.push_back((ball[f - 1].y - ball[f].y) * 480);
  }
  EXPECT_GT(largest(fall), 280);
  const auto touch = static_cast<std::size_t>(std::max_element(foot_fall.begin(), foot_fall.end()) -
                                              foot_fall.begin());
  EXPECT_GT(foot_fall[touch], 250);
  EXPECT_LT(std::fabs(foot_fall[touch + 15]), 1);  // 31 ms later
  EXPECT_GT(fall[touch + 15], 150);
  // The jump starts from a box of 40 cm, and the ball stays where it lands.
  EXPECT_NEAR(ball.front().y - ball.back().y, 40, 0.01);
  for (std::size_t f = touch + 15; f < ball.size(); ++f)
    EXPECT_LT(norm(ball[f] - ball.back()), 0.01);
}

TEST(Gesture, AJumpFallsFreelyAndRisesByAHandSpan) {
  const Take clip = make("jump", 3, 480);
  const auto ball = track(clip, "RightToeBase");
  std::size_t flying = 0;
  double rise = 0;
  for (std::size_t f = 2; f + 2 < ball.size(); ++f) {
    rise = std::max(rise, clip.root_position(f).y - clip.root_position(0).y);
    if (ball[f].y < ball[0].y + 5) continue;
    ++flying;
    const double acceleration =
        (clip.root_position(f + 2).y - 2 * clip.root_position(f).y + clip.root_position(f - 2).y) *
        480 * 480 / 4;
    EXPECT_NEAR(acceleration, -981, 8) << f;
  }
  EXPECT_GT(static_cast<double>(flying) / 480, 0.3);
  EXPECT_GT(rise, 25);
  EXPECT_LT(rise, 50);
}

TEST(Gesture, AWavingHandIsAboveTheHeadAndGoesToAndFro) {
  const Take clip = make("wave", 4, 120);
  const auto hand = track(clip, "RightHand"), head = track(clip, "Head");
  std::size_t turns = 0;
  for (std::size_t f = 150; f < 420; ++f) {
    EXPECT_GT(hand[f].y, head[f].y - 5);
    const double before = hand[f].x - hand[f - 1].x, after = hand[f + 1].x - hand[f].x;
    if (before * after < 0) ++turns;
  }
  EXPECT_GE(turns, 6u);
  EXPECT_LT(largest(speeds(track(clip, "LeftHand"), 120)), 25);
}

TEST(Gesture, StandingStillIsNearlyStill) {
  const Take clip = make("still", 10, 60);
  for (const char* joint : {"Hips", "Head", "LeftHand"}) {
    const auto speed = speeds(track(clip, joint), 60);
    EXPECT_LT(largest(speed), 25) << joint;
    EXPECT_GT(largest(speed), 0.1) << joint;
  }
  EXPECT_LT(largest(speeds(track(clip, "LeftToeBase"), 60)), 1e-6);
}

}  // namespace
}  // namespace kinemend
