// Tests of the damages that displace single samples.
#include <gtest/gtest.h>

#include "kinemend/extend/motion.hpp"
#include "lab/damage/damage_support.hpp"

namespace kinemend {
namespace {

using test::damaged;
using test::degree;
using test::errors_of;
using test::moving_chain;
using test::moving_humanoid;
using test::same_bits;

TEST(Outliers, HitTheShareAskedForAndNothingElse) {
  const Take clean = moving_chain(10, 10000);
  const auto [hit, report] = damaged(clean, "outliers", {{"share", 0.004}, {"std_deg", 25.0}});
  // 100,000 samples: 400 hits, standard deviation 20.
  EXPECT_NEAR(static_cast<double>(report.samples_damaged), 400, 80);
  double square = 0;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < clean.rotations.size(); ++i) {
    if (same_bits(clean.rotations[i], hit.rotations[i])) continue;
    const double angle = angle_between(clean.rotations[i], hit.rotations[i]) / degree;
    square += angle * angle;
    ++changed;
  }
  EXPECT_EQ(changed, report.samples_damaged);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(changed)), 25 * std::sqrt(3.0), 4);
}

TEST(Impulses, AreOfOneSize) {
  const Take clean = moving_chain(10, 2000);
  const auto [hit, report] = damaged(clean, "impulse", {{"share", 0.05}, {"size_deg", 60.0}});
  EXPECT_NEAR(static_cast<double>(report.samples_damaged), 1000, 150);
  Vec3 mean;
  for (const Vec3 e : errors_of(clean, hit, 4)) {
    if (norm(e) > 1e-6) {
      EXPECT_NEAR(norm(e), 60 * degree, 1e-9);
    }
    mean += 0.01 * e;
  }
  EXPECT_LT(norm(mean), 0.5) << "in all directions";
}

TEST(OutlierScale, MultipliesRotationVectors) {
  const Take clean = moving_chain(4, 2000);
  const auto [hit, report] =
      damaged(clean, "outlier-scale",
              {{"share", 0.1}, {"factor", 1.4}, {"value", std::string("rotation")}});
  EXPECT_NEAR(static_cast<double>(report.samples_damaged), 600, 100) << "the root is left out";
  for (std::size_t f = 0; f < 2000; ++f) {
    if (same_bits(clean.rotation(f, 2), hit.rotation(f, 2))) continue;
    EXPECT_NEAR(norm(log(hit.rotation(f, 2)) - 1.4 * log(clean.rotation(f, 2))), 0, 1e-12);
  }
}

TEST(OutlierScale, OfAPositionMovesJustThatBoneThere) {
  // With one joint named, only its own bone and the bones below it may turn.
  const Take clean = moving_humanoid(500);
  const auto [hit, report] =
      damaged(clean, "outlier-scale", {{"share", 0.1}, {"joints", std::string("LeftForeArm")}});
  std::size_t frames_hit = 0;
  const auto arm = static_cast<std::size_t>(clean.skeleton.find("LeftArm"));
  for (std::size_t f = 0; f < 500; ++f) {
    bool changed = false;
    for (std::size_t j = 0; j < clean.joint_count(); ++j) {
      const std::string& name = clean.skeleton.names[j];
      const bool near = name == "LeftArm" || name == "LeftForeArm" || name == "LeftHand";
      const bool same = same_bits(clean.rotation(f, j), hit.rotation(f, j));
      EXPECT_TRUE(same || near) << name;
      changed = changed || !same;
    }
    frames_hit += changed;
    EXPECT_EQ(changed, !same_bits(clean.rotation(f, arm), hit.rotation(f, arm)));
  }
  // The share of frames with at least one of three coordinates hit: 1 - 0.9^3 = 0.271.
  EXPECT_NEAR(static_cast<double>(frames_hit), 135.5, 35);
}

TEST(OutlierScale, PointsABoneAtTheScaledPosition) {
  const Take clean = moving_humanoid(50);
  const auto [hit, report] =
      damaged(clean, "outlier-scale",
              {{"share", 1.0}, {"factor", 1.4}, {"joints", std::string("LeftForeArm")}});
  const auto arm = static_cast<std::size_t>(clean.skeleton.find("LeftArm")), elbow = arm + 1;
  for (std::size_t f = 0; f < 50; ++f) {
    const Pose before = forward_kinematics(clean, f), after = forward_kinematics(hit, f);
    const Vec3 target = before.positions[0] + 1.4 * (before.positions[elbow] - before.positions[0]);
    const Vec3 aim = target - after.positions[arm],
               bone = after.positions[elbow] - after.positions[arm];
    EXPECT_NEAR(dot(aim, bone) / (norm(aim) * norm(bone)), 1, 1e-12);
    EXPECT_NEAR(norm(bone), 28, 1e-9) << "bone length";
  }
}

}  // namespace
}  // namespace kinemend
