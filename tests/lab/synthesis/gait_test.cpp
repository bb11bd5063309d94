// Tests of synthetic gait: standing feet, and published angles and speeds.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "lab/synthesis/measure.hpp"

namespace kinemend {
namespace {

using measure::horizontal;
using measure::largest;
using measure::least;
using measure::make;
using measure::rests;
using measure::track;

// Mean knee flexion at every 2 % of the stride, degrees: Schwartz, Rozumalski and Trost, J.
// Biomech. 41 (2008) 1639-1650.
constexpr std::array<double, 50> published_knee{
    5.5,  7.9,  11.0, 14.4, 17.2, 18.9, 19.7, 19.6, 18.9, 18.0, 16.9, 15.7, 14.5,
    13.2, 12.0, 10.8, 9.8,  8.8,  7.9,  7.2,  6.8,  6.7,  7.1,  8.0,  9.5,  11.6,
    14.4, 18.1, 22.6, 28.0, 34.1, 40.6, 47.0, 52.5, 56.8, 59.4, 60.5, 60.0, 58.2,
    55.0, 50.8, 45.5, 39.5, 32.9, 26.0, 19.0, 12.6, 7.5,  4.5,  3.8};

// Frames of the local maxima above `threshold`.
std::vector<std::size_t> peaks(const std::vector<double>& values, double threshold) {
  std::vector<std::size_t> result;
  for (std::size_t f = 1; f + 1 < values.size(); ++f) {
    if (values[f] > threshold && values[f] >= values[f - 1] && values[f] > values[f + 1])
      result.push_back(f);
  }
  return result;
}

TEST(Gait, AStandingFootStaysWhereItIs) {
  for (const char* motion : {"walk", "run", "turn", "stroll"}) {
    for (std::uint64_t seed : {1, 2, 3}) {
      const Take clip = make(motion, 6, 120, seed);
      for (const char* joint : {"LeftToeBase", "RightToeBase"}) {
        const auto ball = track(clip, joint);
        const auto stances = rests(ball, 12);
        EXPECT_GE(stances.size(), 5u) << motion;
        for (const auto& stance : stances) {
          for (std::size_t f = stance.first; f < stance.last; ++f) {
            const std::size_t middle = (stance.first + stance.last) / 2;
            ASSERT_LT(horizontal(ball[f], ball[middle]), 0.1) << motion << ' ' << joint << ' ' << f;
          }
        }
      }
    }
  }
}

TEST(Gait, TheSoleRestsOnTheGroundInMidStance) {
  const Take clip = make("walk", 6);
  const auto ankle = track(clip, "LeftFoot");
  const auto flat = rests(ankle, 20);
  EXPECT_GE(flat.size(), 4u);
  for (const auto& rest : flat) {
    for (std::size_t f = rest.first; f < rest.last; ++f) {
      EXPECT_LT(horizontal(ankle[f], ankle[rest.first + 1]), 0.2);
    }
  }
}

TEST(Gait, NothingGoesThroughTheFloor) {
  for (std::string_view motion : synth_motions()) {
    if (motion == "spin") continue;
    const Take clip = make(std::string(motion), 6, 60, 2);
    double lowest = 0;
    for (Vec3 p : joint_positions(clip, true)) lowest = std::min(lowest, p.y);
    EXPECT_GT(lowest, -1.0) << motion;
  }
}

TEST(Gait, AWalkerAlwaysStandsAndARunnerFlies) {
  for (const char* motion : {"walk", "run"}) {
    const Take clip = make(motion, 6, 240);
    std::vector<int> feet_down(clip.frame_count(), 0);
    for (const char* joint : {"LeftToeBase", "RightToeBase"}) {
      for (const auto& stance : rests(track(clip, joint), 10)) {
        for (std::size_t f = stance.first; f < stance.last; ++f) ++feet_down[f];
      }
    }
    std::array<double, 3> share{};
    for (int feet : feet_down)
      share[static_cast<std::size_t>(feet)] += 1.0 / static_cast<double>(feet_down.size());
    if (motion == std::string("walk")) {
      // Counts only the balls of the feet; the heel lands earlier and adds 8 % per step.
      EXPECT_LT(share[0], 0.02);
      EXPECT_GT(share[2], 0.02);
    } else {
      EXPECT_GT(share[0], 0.25);
      EXPECT_EQ(share[2], 0);
    }
  }
}

TEST(Gait, WalkingAnglesFollowThePublishedCurves) {
  const Take clip = make("walk", 10, 120);
  const auto knee = measure::turn_about_x(clip, "LeftLeg");
  EXPECT_NEAR(largest(knee), 60, 6);
  EXPECT_GT(least(knee), 2);
  auto hip = measure::turn_about_x(clip, "RightUpLeg");
  EXPECT_NEAR(-least(hip), 35, 6);
  EXPECT_NEAR(-largest(hip), -10, 6);
  auto ankle = measure::turn_about_x(clip, "LeftFoot");
  EXPECT_NEAR(-least(ankle), 12, 9);
  EXPECT_NEAR(-largest(ankle), -17, 9);

  // Strides run from one swing peak, at 72 %, to the next.
  const auto at = peaks(knee, 50);
  ASSERT_GE(at.size(), 6u);
  for (std::size_t i = 1; i < at.size(); ++i) {
    double squares = 0;
    for (std::size_t k = 0; k < 50; ++k) {
      const double phase = std::fmod(0.02 * static_cast<double>(k) + 0.28, 1.0);
      const double frame =
          static_cast<double>(at[i - 1]) + phase * static_cast<double>(at[i] - at[i - 1]);
      const double error = knee[static_cast<std::size_t>(std::lround(frame))] - published_knee[k];
      squares += error * error / 50;
    }
    EXPECT_LT(std::sqrt(squares), 8) << i;
  }
}

TEST(Gait, SpeedAndCadenceAreThoseOfPeople) {
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    for (const char* motion : {"walk", "run"}) {
      const bool walking = motion == std::string("walk");
      const Take clip = make(motion, 8, 120, seed);
      const double speed =
          horizontal(clip.root_position(0), clip.root_position(clip.frame_count() - 1)) / 8;
      EXPECT_GT(speed, walking ? 110 : 260) << motion;
      EXPECT_LT(speed, walking ? 150 : 380) << motion;
      const auto at = peaks(measure::turn_about_x(clip, "LeftLeg"), walking ? 50 : 80);
      ASSERT_GE(at.size(), 5u);
      const double stride_s =
          static_cast<double>(at.back() - at.front()) / 120 / static_cast<double>(at.size() - 1);
      EXPECT_NEAR(stride_s, walking ? 1.10 : 0.71, walking ? 0.08 : 0.06);
    }
  }
}

TEST(Gait, StepsOfBothSidesAreAlikeButNotEqual) {
  const Take clip = make("walk", 30, 60);
  std::vector<std::pair<double, int>> prints;  // distance along the path, side
  for (int side = 0; side < 2; ++side) {
    const auto ball = track(clip, side == 0 ? "LeftToeBase" : "RightToeBase");
    for (const auto& stance : rests(ball, 15))
      prints.push_back({ball[(stance.first + stance.last) / 2].z, side});
  }
  std::sort(prints.begin(), prints.end());
  std::array<std::vector<double>, 2> steps;
  for (std::size_t i = 1; i < prints.size(); ++i) {
    ASSERT_NE(prints[i].second, prints[i - 1].second);
    steps[static_cast<std::size_t>(prints[i].second)].push_back(prints[i].first -
                                                                prints[i - 1].first);
  }
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  EXPECT_NEAR(mean(steps[0]), mean(steps[1]), 1.0);
  EXPECT_NEAR(mean(steps[0]), 69, 8);
  EXPECT_GT(largest(steps[0]) - least(steps[0]), 0.3);
}

TEST(Gait, ATurnPassesAFullCircleAndTheSeamOfTheAngles) {
  for (std::uint64_t seed : {1, 2, 3}) {
    const Take clip = make("turn", 6, 120, seed);
    double heading = 0, seams = 0, last = 0;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const Vec3 forward = rotate(clip.rotation(f, 0), {0, 0, 1});
      const double yaw = std::atan2(forward.x, forward.z) * degrees_per_radian;
      if (f > 0) {
        heading += wrap_angle(yaw - last, 180);
        if (std::fabs(yaw - last) > 180) ++seams;
      }
      last = yaw;
    }
    EXPECT_GT(std::fabs(heading), 370);
    EXPECT_GE(seams, 1);
  }
}

}  // namespace
}  // namespace kinemend
