// Properties of every damage in the table.
#include <gmock/gmock.h>

#include <set>

#include "kinemend/error.hpp"
#include "lab/damage/damage_support.hpp"

namespace kinemend {
namespace {

using test::damaged;
using test::moving_humanoid;
using test::same_bits;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Property;
using testing::Throws;
using testing::ThrowsMessage;

TEST(Damages, AreAllThereWithTextsAndOptions) {
  std::set<std::string> names;
  for (const Damage& damage : damages()) {
    EXPECT_TRUE(names.insert(damage.name).second) << damage.name;
    EXPECT_FALSE(damage.summary.empty()) << damage.name;
    EXPECT_FALSE(damage.options.empty()) << damage.name;
    for (const OptionSpec& option : damage.options)
      EXPECT_FALSE(option.help.empty()) << damage.name << option.name;
  }
  const std::set<std::string> wanted{
      "gaussian", "gaussian-channels", "gaussian-log", "uniform",       "ar1",
      "bias",     "sinusoid",          "outliers",     "outlier-scale", "impulse",
      "snr",      "position-noise",    "frozen",       "gaps",          "long-gap",
      "held",     "upsampled",         "system"};
  EXPECT_EQ(names, wanted);
}

class EveryDamage : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Table, EveryDamage, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Damage& damage : damages()) names.push_back(damage.name);
                           return names;
                         }()),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

bool same_clip(const Take& a, const Take& b) {
  if (a.rotations.size() != b.rotations.size()) return false;
  for (std::size_t i = 0; i < a.rotations.size(); ++i) {
    if (!same_bits(a.rotations[i], b.rotations[i])) return false;
  }
  return a.positions == b.positions && a.observed == b.observed;
}

TEST_P(EveryDamage, GivesTheSameBytesForTheSameSeedAndOthersForAnother) {
  const Take clean = moving_humanoid(200);
  const auto first = damaged(clean, GetParam(), {}, 7), again = damaged(clean, GetParam(), {}, 7);
  EXPECT_TRUE(same_clip(first.clip, again.clip));
  EXPECT_FALSE(same_clip(first.clip, clean));
  if (GetParam() == "held" || GetParam() == "upsampled") return;  // these damages are deterministic
  EXPECT_FALSE(same_clip(first.clip, damaged(clean, GetParam(), {}, 8).clip));
}

TEST_P(EveryDamage, LeavesAValidClipAndReportsWhatItDid) {
  const Take clean = moving_humanoid(200);
  const auto [clip, report] = damaged(clean, GetParam());
  clip.validate();
  EXPECT_EQ(report.kind, GetParam());
  EXPECT_EQ(report.samples, 200 * clean.joint_count());
  std::size_t changed = 0;
  double square = 0, largest = 0;
  for (std::size_t i = 0; i < clean.rotations.size(); ++i) {
    const bool lost = !clip.observed.empty() && !clip.observed[i];
    changed += lost || !same_bits(clean.rotations[i], clip.rotations[i]);
    const double angle = angle_between(clean.rotations[i], clip.rotations[i]) / test::degree;
    square += angle * angle;
    largest = std::max(largest, angle);
  }
  EXPECT_EQ(report.samples_damaged, changed);
  EXPECT_NEAR(report.rms_deg, std::sqrt(square / static_cast<double>(report.samples)), 1e-9);
  EXPECT_NEAR(report.max_deg, largest, 1e-9);
  EXPECT_GT(report.rms_deg, 0);
  EXPECT_GT(report.rms_position, 0);
}

TEST_P(EveryDamage, LeavesTheRootAloneWhenAsked) {
  const Take clean = moving_humanoid(100);
  const auto [clip, report] = damaged(clean, GetParam(), {{"root", false}});
  for (std::size_t f = 0; f < 100; ++f) {
    ASSERT_TRUE(same_bits(clean.rotation(f, 0), clip.rotation(f, 0)));
    ASSERT_EQ(clean.root_position(f), clip.root_position(f));
  }
}

TEST_P(EveryDamage, TouchesNoJointWithoutRotationChannels) {
  Take clean = moving_humanoid(100);
  const std::size_t fixed = static_cast<std::size_t>(clean.skeleton.find("LeftForeArm"));
  clean.skeleton.channels[fixed].clear();
  OptionValues values;
  if (GetParam() == "frozen" || GetParam() == "gaps" || GetParam() == "long-gap")
    values["scope"] = std::string("all");
  const auto [clip, report] = damaged(clean, GetParam(), values);
  EXPECT_GT(report.samples_damaged, 0u);
  for (std::size_t f = 0; f < 100; ++f)
    ASSERT_TRUE(same_bits(clean.rotation(f, fixed), clip.rotation(f, fixed)));
}

TEST_P(EveryDamage, KeepsHingesOnTheirAxis) {
  Take clean = moving_humanoid(100);
  const std::size_t hinge = static_cast<std::size_t>(clean.skeleton.find("LeftLeg"));
  clean.skeleton.channels[hinge] = {Channel::x_rotation};
  for (std::size_t f = 0; f < 100; ++f)
    clean.rotation(f, hinge) = test::about_x(0.01 * static_cast<double>(f));
  const auto [clip, report] = damaged(clean, GetParam());
  for (std::size_t f = 0; f < 100; ++f) {
    const Quat q = clip.rotation(f, hinge);
    ASSERT_NEAR(std::hypot(q.y, q.z), 0, 1e-12);
  }
}

TEST_P(EveryDamage, LeavesTheCalibrationPoseAloneAndSaysSo) {
  const Take motion = moving_humanoid(100);
  Take clean = test::resting_clip(motion.skeleton, 101, 120);
  for (std::size_t f = 0; f < 100; ++f) {
    clean.root_position(f + 1) = motion.root_position(f);
    for (std::size_t j = 0; j < clean.joint_count(); ++j) {
      clean.rotation(f + 1, j) = motion.rotation(f, j) * test::about_z(0.6);
    }
  }
  ASSERT_EQ(leading_calibration_frames(clean), 1u);
  const auto [clip, report] = damaged(clean, GetParam());
  EXPECT_THAT(report.notes,
              Contains(HasSubstr("the first frame (a calibration pose) stays as it is")));
  EXPECT_EQ(report.samples, 100 * clean.joint_count());
  EXPECT_EQ(clip.root_position(0), clean.root_position(0));
  for (std::size_t j = 0; j < clean.joint_count(); ++j) {
    EXPECT_TRUE(same_bits(clip.rotation(0, j), clean.rotation(0, j)));
    EXPECT_TRUE(clip.is_observed(0, j));
  }
  EXPECT_TRUE(clip.observed.empty() || clip.observed.size() == clip.rotations.size());
  // The frames after the pose are damaged as they are without it.
  const Take alone = damaged(slice(clean, 1, 101), GetParam()).clip;
  EXPECT_TRUE(same_clip(slice(clip, 1, 101), alone));
}

TEST_P(EveryDamage, TakesAnyNumberOfFrames) {
  for (const std::size_t frames : {0, 1, 2, 3}) {
    const Take clean = slice(moving_humanoid(3), 0, frames);
    const auto [clip, report] = damaged(clean, GetParam());
    EXPECT_EQ(clip.frame_count(), frames);
    clip.validate();
  }
}

TEST_P(EveryDamage, RefusesUnknownOptionsByName) {
  const Take clean = moving_humanoid(5);
  EXPECT_THAT(
      [&] {
        damaged(clean, GetParam(), {{"amplitude", 3.0}});
      },
      AllOf(Throws<Error>(Property(&Error::kind, ErrorKind::usage)),
            ThrowsMessage<Error>(HasSubstr("unknown option amplitude"))));
}

TEST_P(EveryDamage, GivesAJointTheSameDamageWhateverOthersGet) {
  if (GetParam() == "long-gap") return;  // its choice depends on the joints given
  const Take clean = moving_humanoid(100);
  const std::size_t arm = static_cast<std::size_t>(clean.skeleton.find("LeftForeArm"));
  const std::string joints =
      GetParam() == "snr" || GetParam() == "position-noise" ? "LeftHand" : "LeftForeArm";
  OptionValues values;
  if (GetParam() == "outlier-scale") values["value"] = std::string("rotation");
  const Take all = damaged(clean, GetParam(), values).clip;
  values["joints"] = joints;
  const Take one = damaged(clean, GetParam(), values).clip;
  if (joints == "LeftForeArm") {
    for (std::size_t f = 0; f < 100; ++f)
      ASSERT_TRUE(same_bits(all.rotation(f, arm), one.rotation(f, arm)));
  }
  for (const char* other : {"Spine1", "RightForeArm", "LeftFoot"}) {
    const auto j = static_cast<std::size_t>(clean.skeleton.find(other));
    for (std::size_t f = 0; f < 100; ++f)
      ASSERT_TRUE(same_bits(clean.rotation(f, j), one.rotation(f, j))) << other;
  }
}

TEST(Damages, ComposeAndDrawNewNoiseEachTime) {
  const Take clean = moving_humanoid(400);
  Take clip = clean;
  Random random(3);
  apply_damage(clip, "gaussian", {{"std_deg", 2.0}}, random);
  const Take once = clip;
  apply_damage(clip, "gaussian", {{"std_deg", 2.0}}, random);
  // Independent noise adds up in squares: each take differs from the one before by 2 sqrt 3, and
  // the sum is sqrt 2 larger.
  const auto rms = [](const Take& a, const Take& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rotations.size(); ++i) {
      const double angle = angle_between(a.rotations[i], b.rotations[i]) / test::degree;
      sum += angle * angle;
    }
    return std::sqrt(sum / static_cast<double>(a.rotations.size()));
  };
  EXPECT_NEAR(rms(clean, once), 2 * std::sqrt(3.0), 0.05);
  EXPECT_NEAR(rms(once, clip), 2 * std::sqrt(3.0), 0.05);
  EXPECT_NEAR(rms(clean, clip), 2 * std::sqrt(6.0), 0.08);
}

TEST(Damages, KeepTheMarksOfGapsMadeBefore) {
  Take clip = moving_humanoid(300);
  Random random(3);
  apply_damage(clip, "gaps", {}, random);
  const auto lost = clip.observed;
  apply_damage(clip, "outliers", {}, random);
  EXPECT_EQ(clip.observed, lost);
  apply_damage(clip, "gaps", {}, random);
  for (std::size_t i = 0; i < lost.size(); ++i) EXPECT_LE(clip.observed[i], lost[i]);
}

TEST(Damages, RefuseUnknownNamesAndBadValues) {
  const Take clean = moving_humanoid(5);
  const auto usage = Throws<Error>(Property(&Error::kind, ErrorKind::usage));
  EXPECT_THAT(
      [&] { damaged(clean, "gausian"); },
      AllOf(usage, ThrowsMessage<Error>(HasSubstr(
                       "unknown damage \"gausian\"; there are gaussian, gaussian-channels"))));
  EXPECT_THAT(
      [&] {
        damaged(clean, "gaussian", {{"std_deg", -1.0}});
      },
      AllOf(usage, ThrowsMessage<Error>("std_deg: -1 is outside 0 to 180 deg")));
  EXPECT_THAT(
      [&] {
        damaged(clean, "gaps", {{"scope", std::string("finger")}});
      },
      AllOf(usage,
            ThrowsMessage<Error>("scope: \"finger\" is not one of channel, joint, limb, all")));
  EXPECT_THAT(
      [&] {
        damaged(clean, "gaussian", {{"joints", std::string("Left*,Tail")}});
      },
      AllOf(usage,
            ThrowsMessage<Error>(HasSubstr("no joint matches \"Tail\" (the joints are Hips, "))));
}

TEST(Damages, TakeJointsByPatterns) {
  const Take clean = moving_humanoid(20);
  const Take clip =
      damaged(clean, "gaussian", {{"joints", std::string("Left*Arm,Hea?,*ToeBase")}}).clip;
  for (std::size_t j = 0; j < clean.joint_count(); ++j) {
    const std::string& name = clean.skeleton.names[j];
    const bool chosen =
        name == "LeftArm" || name == "LeftForeArm" || name == "Head" || name.ends_with("ToeBase");
    EXPECT_EQ(!same_bits(clean.rotation(5, j), clip.rotation(5, j)), chosen) << name;
  }
}

}  // namespace
}  // namespace kinemend
