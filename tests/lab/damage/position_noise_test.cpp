// Tests of position noise: its size, and constant bone lengths.
#include <gmock/gmock.h>

#include <cstdio>

#include "kinemend/extend/motion.hpp"
#include "lab/damage/damage_support.hpp"

namespace kinemend {
namespace {

using test::damaged;
using test::moving_humanoid;
using test::same_bits;
using testing::ElementsAre;
using testing::HasSubstr;

// A star of long bones about a fixed root: each arm ends in one separate bone.
Take star_clip(std::size_t frames) {
  Skeleton s;
  const auto turns = make_channels(false, parse_rotation_order("ZXY"));
  s.add_joint("root", -1, {}, make_channels(true, parse_rotation_order("ZXY")));
  const Vec3 arms[] = {{100, 0, 0}, {0, 100, 0}, {0, 0, 100}};
  for (int i = 0; i < 3; ++i) {
    s.add_joint("arm" + std::to_string(i), 0, {}, turns);
    s.add_joint("end" + std::to_string(i), static_cast<std::int32_t>(s.joint_count()) - 1, arms[i],
                turns);
  }
  return test::resting_clip(std::move(s), frames, 100);
}

TEST(PositionNoise, HasTheDeviationAskedForAcrossABone) {
  // The refit keeps noise across a long bone and removes noise along it.
  const Take clean = star_clip(20000);
  const Take noisy = damaged(clean, "position-noise", {{"std_cm", 0.5}, {"cm_per_unit", 1.0}}).clip;
  const auto before = joint_positions(clean), after = joint_positions(noisy);
  const std::size_t joints = clean.joint_count(), end0 = 2;
  std::vector<double> along, y, z;
  for (std::size_t f = 0; f < clean.frame_count(); ++f) {
    const Vec3 d = after[f * joints + end0] - before[f * joints + end0];
    along.push_back(d.x);
    y.push_back(d.y);
    z.push_back(d.z);
  }
  EXPECT_NEAR(test::deviation_of(y), 0.5, 0.01);
  EXPECT_NEAR(test::deviation_of(z), 0.5, 0.01);
  EXPECT_LT(test::deviation_of(along), 0.01);
}

TEST(PositionNoise, KeepsBoneLengthsRootAndLeafRotations) {
  const Take clean = moving_humanoid(200);
  const auto [noisy, report] = damaged(clean, "position-noise", {{"std_cm", 1.0}});
  const auto before = joint_positions(clean), after = joint_positions(noisy);
  const std::size_t joints = clean.joint_count();
  EXPECT_EQ(noisy.positions, clean.positions);
  for (std::size_t f = 0; f < 200; ++f) {
    EXPECT_TRUE(same_bits(noisy.rotation(f, 0), clean.rotation(f, 0)));
    for (std::size_t j = 1; j < joints; ++j) {
      const auto p = static_cast<std::size_t>(clean.skeleton.parents[j]);
      EXPECT_NEAR(norm(after[f * joints + j] - after[f * joints + p]),
                  norm(clean.skeleton.offsets[j]), 1e-9);
    }
  }
  EXPECT_EQ(report.notes, std::vector<std::string>{"a file unit is taken as 1 cm"})
      << "a person of 172 units";
  // The noise is 1 cm per axis; the refit leaves an error of that order.
  EXPECT_GT(report.rms_position, 0.8);
  EXPECT_LT(report.rms_position, 1.9);
}

TEST(PositionNoise, TakesASkeletonOfNoUsualUnitAsATallPerson) {
  Take clip = star_clip(3);
  for (Vec3& offset : clip.skeleton.offsets)
    offset = 5.0 * offset;  // 500 units tall: no usual unit gives a person's height
  const auto report = damaged(clip, "position-noise").report;
  EXPECT_EQ(report.notes, std::vector<std::string>{"a file unit is taken as 0.34 cm"});
}

TEST(PositionNoise, MovesTheRootToo) {
  const Take clean = star_clip(5000);
  const Take noisy =
      damaged(clean, "position-noise", {{"std_cm", 2.0}, {"cm_per_unit", 1.0}, {"root", true}})
          .clip;
  std::vector<double> x;
  for (std::size_t f = 0; f < noisy.frame_count(); ++f) x.push_back(noisy.root_position(f).x);
  EXPECT_NEAR(test::deviation_of(x), 2.0, 0.1);
}

TEST(PositionNoise, IsLargerAtWristsAndAnkles) {
  const Take clean = moving_humanoid(3000);
  const auto speed_of_noise = [&](const Take& noisy, const char* name) {
    const auto before = joint_positions(clean), after = joint_positions(noisy);
    const auto j = static_cast<std::size_t>(clean.skeleton.find(name));
    double sum = 0;
    for (std::size_t i = j; i < before.size(); i += clean.joint_count()) {
      sum += dot(after[i] - before[i], after[i] - before[i]);
    }
    return std::sqrt(sum / 3000);
  };
  const Take same = damaged(clean, "position-noise", {{"std_cm", 0.5}}).clip;
  const Take ends =
      damaged(clean, "position-noise",
              {{"std_cm", 0.5}, {"spread", std::string("ends")}, {"ends_factor", 4.0}})
          .clip;
  for (const char* name : {"LeftHand", "RightHand", "LeftFoot", "RightFoot"}) {
    EXPECT_NEAR(speed_of_noise(ends, name) / speed_of_noise(same, name), 4, 1.2) << name;
  }
  for (const char* name : {"LeftForeArm", "RightLeg", "Head"}) {
    EXPECT_NEAR(speed_of_noise(ends, name) / speed_of_noise(same, name), 1, 0.05) << name;
  }
}

TEST(PositionNoise, SaysWhenNoWristIsFound) {
  const auto report = damaged(star_clip(3), "position-noise",
                              {{"cm_per_unit", 1.0}, {"spread", std::string("ends")}})
                          .report;
  EXPECT_THAT(report.notes,
              ElementsAre("no wrist or ankle found by name: the noise is the same at all joints"));
}

TEST(Snr, IsRealisedToATenthOfADecibel) {
  const Take clean = moving_humanoid(2000);
  for (const double wanted : {10.0, 20.0, 40.0}) {
    const auto report = damaged(clean, "snr", {{"snr_db", wanted}}).report;
    ASSERT_EQ(report.notes.size(), 1u);
    double before = 0, after = 0;
    ASSERT_EQ(std::sscanf(report.notes[0].c_str(),
                          "%lf dB before the bones have their lengths again, %lf dB after", &before,
                          &after),
              2)
        << report.notes[0];
    EXPECT_NEAR(before, wanted, 0.1);
    EXPECT_GT(after, wanted - 2.5);
  }
}

TEST(Snr, AgreesWithItsDefinitionOnTheStar) {
  // Signal: three of six joints are at distance 100 from the root, three at 0, so the mean square
  // of a coordinate is 100^2 / 6. At 20 dB the noise has a hundredth of that power: 4.08 per axis,
  // of which the part across a bone is kept.
  const Take clean = star_clip(10000);
  const Take noisy = damaged(clean, "snr", {{"snr_db", 20.0}}).clip;
  const auto before = joint_positions(clean), after = joint_positions(noisy);
  std::vector<double> y;
  for (std::size_t i = 2; i < before.size(); i += clean.joint_count())
    y.push_back(after[i].y - before[i].y);
  EXPECT_NEAR(test::deviation_of(y), 100 / std::sqrt(600.0), 0.1);
}

}  // namespace
}  // namespace kinemend
