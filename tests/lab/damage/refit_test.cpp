// Tests that no nearby or random rotations fit the positions better than the refit.
#include "lab/damage/refit.hpp"

#include <gtest/gtest.h>

#include "kinemend/extend/motion.hpp"
#include "lab/damage/damage_support.hpp"
#include "lab/damage/targets.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

using corrupt::fit_rotation;
using test::moving_humanoid;
using test::random_rotation;
using test::random_vector;
using test::same_bits;

double misfit(Quat rotation, const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 d = to[i] - rotate(rotation, from[i]);
    sum += dot(d, d);
  }
  return sum;
}

TEST(FitRotation, OfOneBoneIsTheSmallestTurnThatAligns) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Quat clean = random_rotation(random);
    const Vec3 bone = random_vector(random), aim = random_vector(random);
    const Quat fitted = fit_rotation(clean, std::vector{bone}, std::vector{aim});
    const Vec3 turned = rotate(fitted, bone);
    EXPECT_NEAR(norm(cross(turned, aim)) / (norm(bone) * norm(aim)), 0, 1e-12);
    EXPECT_GT(dot(turned, aim), 0);
    const double cosine = dot(rotate(clean, bone), aim) / (norm(bone) * norm(aim));
    EXPECT_NEAR(angle_between(clean, fitted), std::acos(cosine), 1e-6) << "no needless twist";
  }
}

TEST(FitRotation, OfOneBoneTurnsRoundAnOppositeAim) {
  const Quat fitted = fit_rotation({}, std::vector<Vec3>{{0, 2, 0}}, std::vector<Vec3>{{0, -3, 0}});
  const Vec3 turned = rotate(fitted, {0, 2, 0});
  EXPECT_NEAR(norm(turned - Vec3{0, -2, 0}), 0, 1e-12);
}

TEST(FitRotation, OfSeveralBonesIsBetterThanAnyNeighbourOrRandomRotation) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Quat truth = random_rotation(random);
    std::vector<Vec3> from, to;
    for (int i = 0; i < 3; ++i) {
      from.push_back(random_vector(random));
      to.push_back(rotate(truth, from.back()) + random_vector(random, 0.2));
    }
    const Quat clean = truth * exp(random_vector(random, 0.1));
    const Quat fitted = fit_rotation(clean, from, to);
    const double best = misfit(fitted, from, to);
    for (int other = 0; other < 300; ++other) {
      const double reach = other % 3 == 0 ? 3.0 : other % 3 == 1 ? 0.3 : 0.03;
      EXPECT_GT(misfit(fitted * exp(random_vector(random, reach)), from, to), best - 1e-4);
    }
  }
}

TEST(FitRotation, OfSeveralBonesFindsAnExactRotation) {
  Random random(3);
  const Quat truth = random_rotation(random);
  std::vector<Vec3> from, to;
  for (int i = 0; i < 4; ++i) {
    from.push_back(random_vector(random));
    to.push_back(rotate(truth, from.back()));
  }
  EXPECT_LT(angle_between(fit_rotation(truth * exp(Vec3{0.1, 0, 0}), from, to), truth), 1e-4);
  EXPECT_LT(angle_between(fit_rotation(truth, from, to), truth), 1e-7);
}

TEST(FitRotation, KeepsTheTwistThatBonesOnOneLineLeaveOpen) {
  const Quat clean = test::about_x(0.7);  // hips: two bones along x, opposite
  const Quat fitted = fit_rotation(clean, std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}},
                                   std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}});
  EXPECT_LT(angle_between(fitted, clean), 1e-6);
}

TEST(FitRotation, IsCleanWhereBonesHaveNoLength) {
  const Quat clean = test::about_y(0.3);
  EXPECT_TRUE(same_bits(
      fit_rotation(clean, std::vector<Vec3>{{}, {}}, std::vector<Vec3>{{1, 0, 0}, {}}), clean));
  EXPECT_TRUE(same_bits(fit_rotation(clean, {}, {}), clean));
}

TEST(Refit, ToTheCleanPositionsChangesNoBit) {
  const Take clean = moving_humanoid(20);
  Take clip = clean;
  corrupt::refit(clip, joint_positions(clean), std::vector<std::uint8_t>(clean.joint_count(), 1),
                 true);
  EXPECT_EQ(clip.positions, clean.positions);
  for (std::size_t i = 0; i < clean.rotations.size(); ++i) {
    ASSERT_TRUE(same_bits(clip.rotations[i], clean.rotations[i]));
  }
}

TEST(Refit, ReachesPositionsOfAnotherPoseOfTheSameBones) {
  // Positions of another pose can be reached exactly; twists about single bones are free.
  const Take clean = moving_humanoid(5);
  Take other = clean;
  Random random(4);
  for (Quat& q : other.rotations) q = q * exp(random_vector(random, 0.2));
  const auto targets = joint_positions(other);
  Take clip = clean;
  corrupt::refit(clip, targets, std::vector<std::uint8_t>(clean.joint_count(), 1), true);
  const auto found = joint_positions(clip);
  for (std::size_t i = 0; i < targets.size(); ++i)
    EXPECT_NEAR(norm(found[i] - targets[i]), 0, 0.02);
}

TEST(Refit, WorksWithRestRotationsAndTranslatedJoints) {
  Take clean = moving_humanoid(5);
  Random random(5);
  for (Quat& q : clean.skeleton.rest_rotations) q = random_rotation(random);
  test::add_translations(clean, {3, 8},
                         [&](std::size_t, std::size_t) { return random_vector(random, 20); });
  Take other = clean;
  for (Quat& q : other.rotations) q = q * exp(random_vector(random, 0.2));
  const auto targets = joint_positions(other);
  Take clip = clean;
  corrupt::refit(clip, targets, std::vector<std::uint8_t>(clean.joint_count(), 1), true);
  const auto found = joint_positions(clip);
  for (std::size_t i = 0; i < targets.size(); ++i)
    EXPECT_NEAR(norm(found[i] - targets[i]), 0, 0.03);
  for (const std::size_t track : {1, 2})
    EXPECT_EQ(test::point_track(clip, track), test::point_track(clean, track));
}

TEST(Limbs, AreLegsTrunkHeadAndArms) {
  const Skeleton skeleton = test::humanoid_skeleton();
  const auto limb = corrupt::limbs(skeleton);
  const auto of = [&](const char* name) {
    return limb[static_cast<std::size_t>(skeleton.find(name))];
  };
  EXPECT_EQ(of("LeftUpLeg"), of("LeftToeBase"));
  EXPECT_NE(of("LeftUpLeg"), of("RightUpLeg"));
  EXPECT_EQ(of("LeftShoulder"), of("LeftHandThumb1"));
  EXPECT_EQ(of("LeftHandIndex1"), of("LeftHandThumb1")) << "fingers are no limbs";
  EXPECT_NE(of("LeftShoulder"), of("RightShoulder"));
  EXPECT_EQ(of("Neck"), of("Head"));
  EXPECT_NE(of("Neck"), of("Spine1"));
  EXPECT_NE(of("Hips"), of("LeftUpLeg"));
  EXPECT_EQ(*std::max_element(limb.begin(), limb.end()), 6u) << "root, legs, trunk, head, arms";
}

}  // namespace
}  // namespace kinemend
