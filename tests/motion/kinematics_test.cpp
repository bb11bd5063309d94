// Tests of forward kinematics, against sums of angles and products of matrices.
#include "kinemend/extend/motion.hpp"

#include <gtest/gtest.h>

#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::about_x;
using test::about_y;
using test::about_z;
using test::chain_clip;
using test::random_rotation;
using test::random_vector;

void expect_close(Vec3 found, Vec3 expected, double tolerance = 1e-14) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.z, expected.z, tolerance);
}

TEST(ForwardKinematics, OfAPlanarChainIsASumOfAngles) {
  Take clip = chain_clip(4, 1);
  const double a = 0.3, b = -0.8, c = 1.9;
  clip.root_position(0) = {10, 20, 30};
  clip.rotation(0, 0) = about_z(a);
  clip.rotation(0, 1) = about_z(b);
  clip.rotation(0, 2) = about_z(c);
  const Pose pose = forward_kinematics(clip, 0);
  Vec3 p{10, 20, 30};
  double sum = 0;
  expect_close(pose.positions[0], p);
  int joint = 1;
  for (const double angle : {a, b, c}) {
    sum += angle;
    p += Vec3{std::cos(sum), std::sin(sum), 0};
    expect_close(pose.positions[static_cast<std::size_t>(joint++)], p);
  }
  EXPECT_LT(angle_between(pose.rotations[3], about_z(sum)), 1e-15);
}

TEST(ForwardKinematics, TurnsALeafWithoutMovingIt) {
  Take clip = chain_clip(3, 1);
  clip.rotation(0, 2) = about_x(1);
  const Pose pose = forward_kinematics(clip, 0);
  expect_close(pose.positions[2], {2, 0, 0});
  EXPECT_LT(angle_between(pose.rotations[2], about_x(1)), 1e-15);
}

TEST(ForwardKinematics, PutsRestRotationsBeforeLocalOnes) {
  // At rest, the joint's frame is turned by 90 degrees about z, so its x axis points along its
  // parent's y.
  Take clip = chain_clip(3, 1);
  clip.skeleton.rest_rotations[1] = about_z(pi / 2);
  expect_close(forward_kinematics(clip, 0).positions[2], {1, 1, 0});
  clip.rotation(0, 1) = about_y(-pi / 2);  // its x axis to its z, the parent's z
  expect_close(forward_kinematics(clip, 0).positions[2], {1, 0, 1});
  clip.skeleton.rest_rotations[0] = about_x(pi / 2);
  expect_close(forward_kinematics(clip, 0).positions[2], {1, -1, 0});
}

TEST(ForwardKinematics, ReplacesOffsetsByTranslations) {
  Take clip = chain_clip(4, 2);
  clip.translated_joints = {1, 3};
  // Positions of the root, joint 1 and joint 3, in two frames.
  clip.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 5, 0}, {0, 0, 7}};
  clip.rotation(1, 0) = about_z(pi / 2);
  const Pose pose = forward_kinematics(clip, 1);
  expect_close(pose.positions[1], {-5, 0, 0});
  expect_close(pose.positions[2], {-5, 1, 0});
  expect_close(pose.positions[3], {-5, 1, 7});
  expect_close(forward_kinematics(clip, 0).positions[3], {1, 0, 0});
}

TEST(ForwardKinematics, TakesRootPositionsForJoint0AndOffsetsForOtherRoots) {
  Take clip = chain_clip(2, 1);
  clip.skeleton.add_joint("prop", -1, {7, 8, 9}, {});
  clip.skeleton.add_joint("tip", 2, {1, 0, 0}, {});
  clip.rotations.resize(4);
  clip.root_position(0) = {1, 2, 3};
  clip.rotation(0, 2) = about_z(pi / 2);
  const Pose pose = forward_kinematics(clip, 0);
  expect_close(pose.positions[0], {1, 2, 3});
  expect_close(pose.positions[2], {7, 8, 9});
  expect_close(pose.positions[3], {7, 9, 9});
}

TEST(ForwardKinematics, AgreesWithProductsOfMatrices) {
  Take clip = chain_clip(6, 1);
  Random random(1);
  clip.skeleton.parents = {-1, 0, 1, 1, 0, 4};
  for (std::size_t j = 0; j < 6; ++j) {
    clip.skeleton.offsets[j] = random_vector(random);
    clip.skeleton.rest_rotations[j] = random_rotation(random);
    clip.rotation(0, j) = random_rotation(random);
  }
  clip.root_position(0) = random_vector(random);
  const Pose pose = forward_kinematics(clip, 0);
  for (std::size_t j = 0; j < 6; ++j) {
    // Transforms a point of the joint's frame to the world, joint by joint.
    const Vec3 local{0.3, -0.2, 0.5};
    Vec3 point = local;
    for (auto k = static_cast<std::int32_t>(j); k >= 0;
         k = clip.skeleton.parents[static_cast<std::size_t>(k)]) {
      const auto joint = static_cast<std::size_t>(k);
      const Vec3 offset = k == 0 ? clip.root_position(0) : clip.skeleton.offsets[joint];
      point = offset +
              rotate(clip.skeleton.rest_rotations[joint], rotate(clip.rotation(0, joint), point));
    }
    expect_close(pose.positions[j] + rotate(pose.rotations[j], local), point, 1e-13);
  }
}

TEST(JointPositions, AreThoseOfEveryFrameWithEndSitesBehind) {
  Take clip = chain_clip(3, 2);
  clip.skeleton.end_sites.push_back({0, {0, 2, 0}, "top"});
  clip.rotation(1, 0) = about_z(pi / 2);
  const auto joints = joint_positions(clip);
  const auto all = joint_positions(clip, true);
  ASSERT_EQ(joints.size(), 6u);
  ASSERT_EQ(all.size(), 10u);
  for (std::size_t f = 0; f < 2; ++f) {
    const Pose pose = forward_kinematics(clip, f);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(joints[f * 3 + j], pose.positions[j]);
      EXPECT_EQ(all[f * 5 + j], pose.positions[j]);
    }
  }
  expect_close(all[3], {3, 0, 0});
  expect_close(all[4], {0, 2, 0});
  expect_close(all[8], {0, 3, 0});
  expect_close(all[9], {-2, 0, 0});
}

}  // namespace
}  // namespace kinemend
