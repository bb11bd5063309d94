// Tests of the calibration of joint frames by the mean pose.
#include "methods/learned/motion_channels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::test {
namespace {

// A chain with a branch whose references differ from the identity.
BodyLayout small_layout() {
  BodyLayout layout;
  layout.names = {"Hips", "Spine", "LeftArm", "LeftForeArm"};
  layout.parents = {-1, 0, 1, 2};
  layout.references = {exp({0.1, 0.2, 0}), exp({0, 0.3, -0.2}), exp({0.9, 0, 0.4}), exp({0, 1, 0})};
  layout.bones.assign(4, Vec3{0, 1, 0});
  layout.with_place = true;
  return layout;
}

// Motion in degrees whose mean differs from the reference.
PoseMatrix some_motion(const BodyLayout& layout) {
  PoseMatrix poses(90, layout.channel_count());
  Random random(3);
  for (std::size_t c = 0; c < poses.channels; ++c) {
    const double middle = 20 * random.normal(), size = random.uniform(2, 25),
                 at = random.uniform(0, 6);
    for (std::size_t f = 0; f < poses.frames; ++f)
      poses(f, c) = middle + size * std::sin(at + 0.1 * static_cast<double>(f));
  }
  return poses;
}

double largest_difference(const PoseMatrix& one, const PoseMatrix& other) {
  double largest = 0;
  for (std::size_t i = 0; i < one.values.size(); ++i)
    largest = std::max(largest, std::abs(one.values[i] - other.values[i]));
  return largest;
}

PoseMatrix calibrated_by_itself(const PoseMatrix& poses, const BodyLayout& layout) {
  return calibrated(poses, 30, layout, calibration_of(poses, layout));
}

TEST(BodyCalibration, IsTakenBackExactly) {
  const BodyLayout layout = small_layout();
  const PoseMatrix poses = some_motion(layout);
  const BodyCalibration calibration = calibration_of(poses, layout);
  const PoseMatrix there = calibrated(poses, 30, layout, calibration);
  EXPECT_GT(largest_difference(there, poses), 5);
  EXPECT_LT(largest_difference(uncalibrated(there, 30, layout, calibration), poses), 1e-9);
}

TEST(BodyCalibration, PutsTheMeanPoseWhereTheReferenceIs) {
  const BodyLayout layout = small_layout();
  const PoseMatrix there = calibrated_by_itself(some_motion(layout), layout);
  for (const Quat turn : calibration_of(there, layout).turns) EXPECT_LT(norm(log(turn)), 1e-9);
}

TEST(BodyCalibration, TakesOutWhatTheAxesOfBonesAdd) {
  const BodyLayout layout = small_layout();
  const PoseMatrix poses = some_motion(layout);
  // Another rig multiplies each rotation by constants on both sides.
  const BodyCalibration axes{
      {exp({1, 0, 0.3}), exp({0, 0.8, 0}), exp({-0.5, 0.4, 0}), exp({0, 0, 1})}};
  const PoseMatrix turned = calibrated(poses, 30, layout, axes);
  ASSERT_GT(largest_difference(turned, poses), 20);
  EXPECT_LT(
      largest_difference(calibrated_by_itself(turned, layout), calibrated_by_itself(poses, layout)),
      1e-9);
}

TEST(BodyCalibration, LeavesThePlaceAsItIs) {
  const BodyLayout layout = small_layout();
  const PoseMatrix poses = some_motion(layout), there = calibrated_by_itself(poses, layout);
  for (std::size_t f = 0; f < poses.frames; ++f)
    for (std::size_t c = 12; c < 15; ++c) EXPECT_EQ(there(f, c), poses(f, c));
}

}  // namespace
}  // namespace kinemend::test
