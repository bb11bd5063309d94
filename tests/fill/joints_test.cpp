// Tests of gaps of joints: each method, the channels of a joint, and the rules that refuse a gap.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fill/made_gaps.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/take.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using fill::fill_with;
using test::about_x;
using test::about_y;
using test::degree;

std::vector<std::string> joint_methods() {
  std::vector<std::string> names;
  for (const FillMethod& method : fill_methods()) {
    if (method.joints && !method.learned) names.emplace_back(method.name);
  }
  return names;
}

Take with_gaps(Take clip, const std::vector<NamedGap>& gaps) {
  mark_gaps(clip, gaps);
  return fill::spoilt(clip);
}

double error_deg(const Take& a, const Take& b, std::size_t joint, std::size_t first,
                 std::size_t last) {
  double largest = 0;
  for (std::size_t f = first; f <= last; ++f)
    largest = std::max(largest, angle_between(a.rotation(f, joint), b.rotation(f, joint)));
  return largest * degrees_per_radian;
}

TEST(FillJoints, SlerpIsTheGeodesic) {
  Take truth = test::moving_chain(3, 100);
  Take clip = with_gaps(truth, {{"joint1", 40, 48}});
  fill_with(clip, "slerp", true);
  for (std::size_t f = 40; f <= 48; ++f) {
    const Quat expected =
        slerp(truth.rotation(39, 1), truth.rotation(49, 1), (static_cast<double>(f) - 39) / 10);
    EXPECT_LT(angle_between(clip.rotation(f, 1), expected), 1e-9);
  }
}

// A joint that spins about its own axis, with a wobble.
Take spinning(double degrees_per_frame) {
  Take clip = test::chain_clip(2, 300);
  for (std::size_t f = 0; f < 300; ++f) {
    const auto t = static_cast<double>(f);
    clip.rotation(f, 1) =
        about_y(degrees_per_frame * degree * t) * about_x(10 * degree * std::sin(0.05 * t));
  }
  return clip;
}

TEST(FillJoints, TurnsOnThroughHalfATurnAndMore) {
  for (const double speed : {9.0, 10.0, 13.0, 20.0, -14.0}) {  // 189 to 420 degrees in the gap
    const Take truth = spinning(speed);
    for (const char* method : {"spline", "hermite", "quintic"}) {
      Take clip = with_gaps(truth, {{"joint1", 150, 169}});
      fill_with(clip, method, true);
      EXPECT_LT(error_deg(clip, truth, 1, 150, 169), 5) << method << " " << speed;
    }
  }
}

TEST(FillJoints, PassesThroughGimbalLock) {
  // ZXY is in gimbal lock where x is 90 degrees, in the middle of the gap.
  Take truth = test::chain_clip(2, 200);
  for (std::size_t f = 0; f < 200; ++f) {
    const double t = static_cast<double>(f) - 100;
    truth.rotation(f, 1) = about_x((90 + 0.8 * t) * degree) * about_y(0.3 * t * degree);
  }
  Take clip = with_gaps(truth, {{"joint1", 92, 108}});
  fill_with(clip, "hermite");
  EXPECT_LT(error_deg(clip, truth, 1, 92, 108), 1.0);
}

TEST(FillJoints, GivesHingesWhatTheirChannelsCanHold) {
  Skeleton skeleton = test::chain_skeleton(4);
  skeleton.channels[1] = make_channels(false, parse_rotation_order("X"));
  skeleton.channels[2] = make_channels(false, parse_rotation_order("ZX"));
  Take truth = test::resting_clip(skeleton, 200, 100);
  for (std::size_t f = 0; f < 200; ++f) {
    const double t = 0.06 * static_cast<double>(f);
    truth.rotation(f, 1) = from_euler({std::sin(t)}, parse_rotation_order("X"));
    truth.rotation(f, 2) =
        from_euler({std::cos(t), 0.7 * std::sin(1.3 * t)}, parse_rotation_order("ZX"));
  }
  for (const std::string& method : joint_methods()) {
    Take clip = with_gaps(truth, {{"joint1", 100, 112}, {"joint2", 100, 112}});
    fill_with(clip, method, true);
    for (const std::size_t joint : {1u, 2u}) {
      const RotationOrder order = clip.skeleton.rotation_order(joint);
      for (std::size_t f = 100; f <= 112; ++f) {
        const Quat q = clip.rotation(f, joint);
        EXPECT_LT(angle_between(q, from_euler(to_euler(q, order), order)), 1e-7) << method;
      }
      EXPECT_LT(error_deg(clip, truth, joint, 100, 112), 8) << method;
    }
  }
}

// Joint 5 is determined by joints 1 to 4, which move without a period.
Take follower(std::size_t frames) {
  Take clip = test::chain_clip(6, frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = 0.03 * static_cast<double>(f);
    Vec3 sum;
    for (std::size_t j = 1; j < 5; ++j) {
      const auto k = static_cast<double>(j);
      const Vec3 v{0.4 * std::sin(t * std::sqrt(k + 1)), 0.3 * std::cos(t * std::sqrt(k + 5)),
                   0.3 * std::sin(t * std::sqrt(k + 11) + k)};
      clip.rotation(f, j) = exp(v);
      sum += 0.5 * v;
    }
    clip.rotation(f, 5) = exp(sum);
  }
  return clip;
}

TEST(FillJoints, PredictsAJointFromTheOthers) {
  const Take truth = follower(1200);
  Take regression = with_gaps(truth, {{"joint5", 600, 749}});
  Take curve = regression;
  EXPECT_EQ(fill_with(regression, "pca").filled(), 1u);
  fill_with(curve, "pchip", true);
  EXPECT_LT(error_deg(regression, truth, 5, 600, 749), 3);
  EXPECT_GT(error_deg(curve, truth, 5, 600, 749), 15);
}

TEST(FillJoints, AutoTakesWhatDoesBestInTheTake) {
  const Take truth = follower(1200);
  Take clip = with_gaps(truth, {{"joint5", 600, 749}});
  const FillReport report = fill_with(clip, "auto");
  ASSERT_EQ(report.gaps.size(), 1u);
  EXPECT_EQ(report.gaps[0].method, "pca");
  EXPECT_GT(report.gaps[0].expected_error, 0);
  EXPECT_LT(report.gaps[0].expected_error, 3);
}

TEST(FillJoints, RefusesWhatItsRulesDoNotAllow) {
  const Take truth = test::moving_chain(6, 600);
  Take clip = with_gaps(truth, {{"joint1", 50, 99}, {"joint2", 50, 60}});
  const Take before = clip;
  const FillReport report = fill_with(clip, "spline");
  ASSERT_EQ(report.gaps.size(), 2u);
  EXPECT_EQ(report.refused(), 1u);
  EXPECT_FALSE(report.gaps[0].filled);
  EXPECT_EQ(report.gaps[0].reason, "0.5 s is longer than the 0.25 s that spline may fill");
  EXPECT_EQ(clip.rotation(70, 1), before.rotation(70, 1));
  EXPECT_FALSE(clip.is_observed(70, 1));

  FillSettings settings;
  settings.method = "spline";
  settings.longest_gap_s = 0.5;
  EXPECT_EQ(fill_gaps(clip, settings).filled(), 1u);
  settings.longest_gap_s = 0.1;
  clip = before;
  EXPECT_EQ(fill_gaps(clip, settings).filled(), 0u);
  settings.fill_all = true;
  EXPECT_EQ(fill_gaps(clip, settings).refused(), 0u);
}

TEST(FillJoints, FillsTheRootsPositionToo) {
  Take truth = test::moving_chain(4, 300);
  for (std::size_t f = 0; f < 300; ++f) {
    const auto t = static_cast<double>(f);
    truth.root_position(f) = {0.02 * t, 1 + 0.05 * std::sin(0.1 * t), 0};
  }
  Take clip = with_gaps(truth, {{"root", 100, 114}});
  const FillReport report = fill_with(clip, "auto");
  ASSERT_EQ(report.gaps.size(), 2u);
  EXPECT_FALSE(report.gaps[0].is_position);
  EXPECT_TRUE(report.gaps[1].is_position);
  EXPECT_TRUE(report.gaps[1].filled) << report.gaps[1].reason;
  for (std::size_t f = 100; f <= 114; ++f)
    EXPECT_LT(norm(clip.root_position(f) - truth.root_position(f)), 0.02);
  Take other = with_gaps(truth, {{"root", 100, 114}});
  EXPECT_EQ(fill_with(other, "pca").gaps[1].reason, "pca fills no positions");
}

TEST(FillJoints, TakesNoCalibrationPoseForMotion) {
  // Frame 0 is the rest pose; the motion begins in another pose.
  Take truth = test::moving_chain(6, 300);
  const Quat away = about_x(70 * degree);
  for (std::size_t f = 0; f < 300; ++f) {
    for (std::size_t j = 0; j < 6; ++j)
      truth.rotation(f, j) = f == 0 ? Quat{} : away * truth.rotation(f, j);
  }
  ASSERT_EQ(leading_calibration_frames(truth), 1u);
  Take clip = with_gaps(truth, {{"joint2", 1, 3}, {"joint3", 0, 2}});
  clip.rotation(0, 3) = Quat{};
  const FillReport report = fill_with(clip, "hermite");
  ASSERT_EQ(report.gaps.size(), 3u);
  EXPECT_EQ(report.gaps[0].gap, (Gap{2, 1, 3}));
  EXPECT_TRUE(report.gaps[0].filled);
  EXPECT_LT(error_deg(clip, truth, 2, 1, 3), 2);
  EXPECT_EQ(report.gaps[1].gap, (Gap{3, 0, 0}));
  EXPECT_EQ(report.gaps[1].reason, "is part of the calibration pose");
  EXPECT_EQ(report.gaps[2].gap, (Gap{3, 1, 2}));
  EXPECT_TRUE(report.gaps[2].filled);
}

}  // namespace
}  // namespace kinemend
