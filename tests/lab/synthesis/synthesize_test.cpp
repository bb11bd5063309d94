// Tests that synthetic takes are valid, repeatable and continuous, with options in range.
#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "lab/synthesis/measure.hpp"

namespace kinemend {
namespace {

using measure::make;

TEST(Synth, EveryMotionIsAValidClipOfTheLengthAskedFor) {
  for (std::string_view motion : synth_motions()) {
    const Take clip = make(std::string(motion), 1.5, 50, 3);
    EXPECT_NO_THROW(clip.validate()) << motion;
    EXPECT_EQ(clip.frame_count(), 75u) << motion;
    EXPECT_EQ(clip.frame_rate_hz, 50) << motion;
    EXPECT_EQ(leading_calibration_frames(clip), 0u) << motion;
  }
}

TEST(Synth, TheHumanoidHas31JointsAndSixChannelsAtItsRoot) {
  const Take clip = make("walk", 0.1);
  EXPECT_EQ(clip.joint_count(), 31u);
  EXPECT_EQ(clip.skeleton.channels[0].size(), 6u);
  for (std::size_t j = 1; j < 31; ++j) EXPECT_EQ(clip.skeleton.channels[j].size(), 3u);
  EXPECT_EQ(clip.skeleton.end_sites.size(), 7u);
  for (const char* name :
       {"Hips", "Spine", "Neck", "Head", "LeftShoulder", "RightArm", "LeftForeArm", "RightHand",
        "LeftHandThumb1", "RightUpLeg", "LeftLeg", "RightFoot", "LeftToeBase"}) {
    EXPECT_GE(clip.skeleton.find(name), 0) << name;
  }
}

TEST(Synth, SegmentsHaveTheSharesOfBodyHeightThatWinterGives) {
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    const Take pose = synthesize({"still", 0.1, 10, seed, true});
    const auto positions = joint_positions(pose, true);
    double top = 0, wide = 0;
    for (std::size_t i = 0; i < pose.joint_count() + pose.skeleton.end_sites.size(); ++i) {
      top = std::max(top, positions[i].y);
      wide = std::max(wide, positions[i].x);
    }
    EXPECT_GT(top, 155);
    EXPECT_LT(top, 190);
    const auto length = [&](const char* joint) {
      return norm(pose.skeleton.offsets[static_cast<std::size_t>(pose.skeleton.find(joint))]);
    };
    EXPECT_NEAR(length("LeftLeg") / top, 0.245, 0.005);
    EXPECT_NEAR(length("RightFoot") / top, 0.246, 0.005);
    EXPECT_NEAR(length("LeftForeArm") / top, 0.186, 0.005);
    EXPECT_NEAR(length("RightHand") / top, 0.146, 0.005);
    // The span of the arms is about the body height.
    EXPECT_NEAR(2 * wide / top, 1, 0.12);
  }
}

TEST(Synth, TheSameSeedGivesTheSameNumbers) {
  for (std::string_view motion : synth_motions()) {
    const Take a = make(std::string(motion), 1, 60, 7), b = make(std::string(motion), 1, 60, 7);
    EXPECT_EQ(a.rotations, b.rotations) << motion;
    EXPECT_EQ(a.positions, b.positions) << motion;
    const Take other = make(std::string(motion), 1, 60, 8);
    EXPECT_NE(a.rotations, other.rotations) << motion;
  }
}

TEST(Synth, RateAndDurationDoNotChangeTheMotion) {
  for (std::string_view motion : synth_motions()) {
    const Take coarse = make(std::string(motion), 4, 25), fine = make(std::string(motion), 2, 1000);
    for (std::size_t f = 0; f < 50; ++f) {
      EXPECT_LT(norm(coarse.root_position(f) - fine.root_position(40 * f)), 1e-9) << motion;
      for (std::size_t j = 0; j < coarse.joint_count(); ++j) {
        ASSERT_LT(angle_between(coarse.rotation(f, j), fine.rotation(40 * f, j)), 1e-9)
            << motion << f;
      }
    }
  }
}

// A kink in a curve is a change of speed that does not shrink with the time step.
TEST(Synth, MotionIsContinuousAndSoIsItsSpeed) {
  for (std::string_view motion : synth_motions()) {
    const Take clip = make(std::string(motion), 3.2, 1000, 2);
    double speed = 0, jerk = 0;
    for (std::size_t f = 2; f < clip.frame_count(); ++f) {
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        const Vec3 before = log(conjugate(clip.rotation(f - 2, j)) * clip.rotation(f - 1, j));
        const Vec3 after = log(conjugate(clip.rotation(f - 1, j)) * clip.rotation(f, j));
        speed = std::max(speed, norm(after) * degrees_per_radian);
        jerk = std::max(jerk, norm(after - before) * degrees_per_radian);
      }
    }
    EXPECT_LT(speed, 3.0) << motion;  // degrees per millisecond
    EXPECT_LT(jerk, 0.75) << motion;
  }
}

TEST(Synth, FingersRestInAWalk) {
  const Take clip = make("walk", 3);
  for (const char* name :
       {"LeftHandIndex1", "LeftHandThumb2", "RightHandIndex2", "RightHandThumb1"}) {
    const auto j = static_cast<std::size_t>(clip.skeleton.find(name));
    for (std::size_t f = 1; f < clip.frame_count(); ++f)
      EXPECT_EQ(clip.rotation(f, j), clip.rotation(0, j));
  }
}

TEST(Synth, ATPoseComesBeforeTheMotionWhenAskedFor) {
  for (std::string_view motion : {"walk", "run", "punch", "stroll"}) {
    const Take plain = synthesize({std::string(motion), 2, 120, 4, false});
    const Take posed = synthesize({std::string(motion), 2, 120, 4, true});
    ASSERT_EQ(posed.frame_count(), plain.frame_count() + 1) << motion;
    EXPECT_EQ(leading_calibration_frames(posed), 1u) << motion;
    for (std::size_t j = 0; j < posed.joint_count(); ++j) EXPECT_EQ(posed.rotation(0, j), Quat{});
    EXPECT_EQ(posed.root_position(9), plain.root_position(8));
    EXPECT_LT(angle_between(posed.rotation(9, 2), plain.rotation(8, 2)), 1e-12);
  }
}

TEST(Synth, AChainSpinsThroughHalfTurnsAndNearlyLocksItsEulerAngles) {
  const Take clip = make("spin", 6, 120);
  double steepest = 0, travelled = 0;
  std::array<double, 3> last{};
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto angles = to_euler_near(clip.rotation(f, 0), clip.skeleton.rotation_order(0), last);
    if (f > 0) travelled += angles[0] - last[0];
    last = angles;
    steepest = std::max(steepest, std::fabs(angles[1]) * degrees_per_radian);
  }
  EXPECT_NEAR(steepest, 88, 0.1);
  EXPECT_GT(std::fabs(travelled) * degrees_per_radian, 400);
}

TEST(Synth, OptionsOutOfRangeAreUsageErrors) {
  const auto kind_of = [](const SynthOptions& options) {
    try {
      synthesize(options);
    } catch (const Error& e) {
      return e.kind();
    }
    return ErrorKind::cannot_write;
  };
  EXPECT_EQ(kind_of({"moonwalk", 1, 120, 1, false}), ErrorKind::usage);
  EXPECT_EQ(kind_of({"walk", 0.05, 120, 1, false}), ErrorKind::usage);
  EXPECT_EQ(kind_of({"walk", 601, 120, 1, false}), ErrorKind::usage);
  EXPECT_EQ(kind_of({"walk", 1, 0.5, 1, false}), ErrorKind::usage);
  EXPECT_EQ(kind_of({"walk", 1, 1001, 1, false}), ErrorKind::usage);
  EXPECT_EQ(kind_of({"walk", std::nan(""), 120, 1, false}), ErrorKind::usage);
  try {
    synthesize({"moonwalk", 1, 120, 1, false});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("walk, run, jump"), std::string::npos);
  }
}

TEST(Synth, ALongTakeStaysOnItsFeet) {
  const Take clip = make("run", 600, 2);
  clip.validate();
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_GT(clip.root_position(f).y, 75);
    EXPECT_LT(clip.root_position(f).y, 110);
  }
  const Vec3 span = clip.root_position(clip.frame_count() - 1) - clip.root_position(0);
  EXPECT_NEAR(norm(span) / 600, 310, 60);
}

}  // namespace
}  // namespace kinemend
