// Tests of takes of joints: validity, slices, and leading calibration frames.
#include "kinemend/take.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "kinemend/error.hpp"
#include "motion/clips.hpp"
#include "motion/take.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

using test::about_x;
using test::about_z;
using test::chain_clip;
using test::chain_skeleton;
using test::degree;
using test::moving_chain;
using test::random_vector;
using testing::AllOf;
using testing::ElementsAre;
using testing::Property;
using testing::Throws;
using testing::ThrowsMessage;

auto usage(const char* message) {
  return AllOf(Throws<Error>(Property(&Error::kind, ErrorKind::usage)),
               ThrowsMessage<Error>(message));
}

Take full_clip() {
  Take clip = moving_chain(3, 5);
  test::add_translations(clip, {1}, [](std::size_t f, std::size_t) {
    return Vec3{static_cast<double>(f), 1, 2};
  });
  clip.observed.assign(15, 1);
  clip.observed[7] = 0;
  clip.source = {"walk.bvh", "bvh", std::make_shared<SourceDocument>()};
  return clip;
}

template <class Change>
auto validating(Change change) {
  Take clip = full_clip();
  change(clip);
  return [clip] { clip.validate(); };
}

TEST(JointSamples, ArePointsAndRotations) {
  Take clip = moving_chain(4, 5);
  test::add_translations(clip, {1, 3}, Vec3{0, 0, 1});
  EXPECT_EQ(point_of_joint(clip, 0), std::size_t{0});
  EXPECT_EQ(point_of_joint(clip, 1), std::size_t{1});
  EXPECT_FALSE(point_of_joint(clip, 2).has_value());
  EXPECT_EQ(point_of_joint(clip, 3), std::size_t{2});
  EXPECT_THAT(rotations_of(clip, 2, 3), ElementsAre(clip.rotation(3, 2), clip.rotation(4, 2)));
  EXPECT_EQ(rotations_of(clip, 2).size(), 5u);
  EXPECT_TRUE(rotations_of(clip, 2, 5).empty());
}

TEST(ClipRules, AcceptGoodClips) {
  EXPECT_NO_THROW(full_clip().validate());
  EXPECT_NO_THROW(chain_clip(2, 0).validate());
}

TEST(ClipRules, NameTheFirstFrameAndJointThatBreaksOne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(validating([](Take& c) { c.skeleton.parents[0] = 1; }),
              usage("joint 0 is not a root"));
  EXPECT_THAT(validating([](Take& c) { c.frame_rate_hz = 0; }),
              usage("a frame rate of 0 Hz is outside 0.1 to 100000 Hz"));
  EXPECT_THAT(validating([&](Take& c) { c.frame_rate_hz = infinity; }),
              usage("a frame rate of inf Hz is outside 0.1 to 100000 Hz"));
  EXPECT_THAT(validating([](Take& c) { c.rotations.pop_back(); }),
              usage("rotations: 14 values, expected 15"));
  EXPECT_THAT(validating([](Take& c) { c.positions.pop_back(); }),
              usage("positions: 9 values, expected 8"));
  EXPECT_THAT(validating([](Take& c) { c.observed.pop_back(); }),
              usage("observed mask: 14 values, expected 15"));
  const auto bad_joints = usage("translated joints are not ascending joint numbers above 0");
  EXPECT_THAT(validating([](Take& c) { c.translated_joints = {0}; }), bad_joints);
  EXPECT_THAT(validating([](Take& c) { c.translated_joints = {3}; }), bad_joints);
  EXPECT_THAT(validating([](Take& c) {
                c.translated_joints = {2, 1};
                c.positions.resize(15);
              }),
              bad_joints);
  EXPECT_THAT(validating([&](Take& c) { c.root_position(2).z = nan; }),
              usage("frame 2: root position is not finite"));
  EXPECT_THAT(validating([](Take& c) { c.rotation(3, 1).w += 0.01; }),
              usage("frame 3, joint \"joint1\": rotation is not a unit quaternion"));
  EXPECT_THAT(validating([&](Take& c) { c.rotation(4, 2).x = nan; }),
              usage("frame 4, joint \"joint2\": rotation is not a unit quaternion"));
  EXPECT_THAT(validating([&](Take& c) { c.position(1, 1).x = infinity; }),
              usage("a joint translation is not finite"));
}

TEST(Take, KnowsItsSizesAndWhatWasObserved) {
  const Take clip = full_clip();
  EXPECT_EQ(clip.frame_count(), 5u);
  EXPECT_EQ(clip.joint_count(), 3u);
  EXPECT_NEAR(clip.duration_s(), 0.05, 1e-15);
  EXPECT_FALSE(clip.is_observed(2, 1));
  EXPECT_TRUE(clip.is_observed(2, 2));
  EXPECT_TRUE(chain_clip(2, 2).is_observed(1, 1)) << "no mask: all of them";
}

TEST(Slice, HoldsTheFramesAskedForAndNoSourceDocument) {
  const Take clip = full_clip();
  const Take part = slice(clip, 1, 4);
  part.validate();
  EXPECT_EQ(part.frame_count(), 3u);
  EXPECT_EQ(part.frame_rate_hz, clip.frame_rate_hz);
  EXPECT_EQ(part.source.name, "walk.bvh");
  EXPECT_EQ(part.source.document, nullptr);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(part.root_position(f), clip.root_position(f + 1));
    EXPECT_EQ(part.position(f, 1), clip.position(f + 1, 1));
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(part.rotation(f, j), clip.rotation(f + 1, j));
      EXPECT_EQ(part.is_observed(f, j), clip.is_observed(f + 1, j));
    }
  }
  EXPECT_EQ(slice(clip, 2, 2).frame_count(), 0u);
  EXPECT_TRUE(slice(moving_chain(2, 4), 1, 3).observed.empty());
}

// A chain that moves about a pose far from rest, as a person does, after `pose_frames` frames of
// T-pose.
Take take_with_pose(std::size_t pose_frames, std::size_t frames) {
  const Take motion = moving_chain(8, frames, 120);
  Take clip = test::resting_clip(motion.skeleton, pose_frames + frames, 120);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < 8; ++j)
      clip.rotation(pose_frames + f, j) = about_z(0.7) * motion.rotation(f, j);
  }
  return clip;
}

TEST(LeadingCalibrationFrames, FindsATPoseFirst) {
  EXPECT_EQ(leading_calibration_frames(take_with_pose(1, 300)), 1u);
  EXPECT_EQ(leading_calibration_frames(take_with_pose(1, 2)), 1u);
}

TEST(LeadingCalibrationFrames, FindsATPoseWithATurnedRootAndHips) {
  Take clip = take_with_pose(1, 300);
  clip.rotation(0, 0) = test::about_y(2);
  clip.rotation(0, 1) = about_z(21 * degree);
  clip.rotation(0, 2) = about_z(-21 * degree);
  EXPECT_EQ(leading_calibration_frames(clip), 1u);
}

TEST(LeadingCalibrationFrames, FindsATPoseOfSomeFrames) {
  EXPECT_EQ(leading_calibration_frames(take_with_pose(5, 300)), 5u);
}

TEST(LeadingCalibrationFrames, FindsItInANoisyTakeWithSpikes) {
  Take clip = take_with_pose(1, 300);
  Random random(1);
  for (std::size_t i = 8; i < clip.rotations.size(); ++i) {
    Quat& q = clip.rotations[i];
    q = q * exp(random_vector(random, 1.5 * degree));
    if (random.chance(0.01)) q = q * exp(random_vector(random, 40 * degree));
  }
  EXPECT_EQ(leading_calibration_frames(clip), 1u);
}

TEST(LeadingCalibrationFrames, FindsNoneInACleanTake) {
  EXPECT_EQ(leading_calibration_frames(take_with_pose(0, 300)), 0u);
  EXPECT_EQ(leading_calibration_frames(moving_chain(8, 300)), 0u);
  EXPECT_EQ(leading_calibration_frames(chain_clip(8, 300)), 0u) << "at rest throughout";
}

TEST(LeadingCalibrationFrames, FindsNoneWhereMotionStartsFromTheRestPose) {
  // The motion starts at rest with constant acceleration; the fastest ends at 40 degrees per frame
  // and more.
  for (const double speed : {0.5, 2.0, 5.0}) {
    Take clip = chain_clip(6, 20, 30);
    for (std::size_t f = 0; f < 20; ++f) {
      const double t = static_cast<double>(f);
      for (std::size_t j = 1; j < 6; ++j) clip.rotation(f, j) = about_x(speed * t * t / 2 * degree);
    }
    EXPECT_EQ(leading_calibration_frames(clip), 0u) << speed;
  }
  // The motion has constant speed from the first frame on, as in hand-keyed takes.
  Take clip = chain_clip(6, 20, 30);
  for (std::size_t f = 0; f < 20; ++f) {
    for (std::size_t j = 1; j < 6; ++j)
      clip.rotation(f, j) = about_x(30.0 * degree * static_cast<double>(f));
  }
  EXPECT_EQ(leading_calibration_frames(clip), 0u);
}

TEST(LeadingCalibrationFrames, FindsNoneInAFrozenFirstFrame) {
  Take clip = take_with_pose(0, 300);
  for (std::size_t f = 1; f < 4; ++f) {
    for (std::size_t j = 0; j < 8; ++j) clip.rotation(f, j) = clip.rotation(0, j);
  }
  EXPECT_EQ(leading_calibration_frames(clip), 0u);
}

TEST(LeadingCalibrationFrames, FindsNoneInAPersonStandingInTPoseForLong) {
  EXPECT_EQ(leading_calibration_frames(take_with_pose(60, 300)), 0u);
}

TEST(LeadingCalibrationFrames, NeverTakesAllFrames) {
  EXPECT_EQ(leading_calibration_frames(chain_clip(8, 0)), 0u);
  EXPECT_EQ(leading_calibration_frames(chain_clip(8, 1)), 0u);
  EXPECT_EQ(leading_calibration_frames(chain_clip(8, 2)), 0u);
  EXPECT_EQ(leading_calibration_frames(chain_clip(8, 5)), 0u);
  EXPECT_EQ(leading_calibration_frames(take_with_pose(1, 1)), 0u);
  EXPECT_EQ(leading_calibration_frames(take_with_pose(2, 0)), 0u);
  EXPECT_EQ(leading_calibration_frames(chain_clip(1, 5)), 0u) << "roots only";
}

}  // namespace
}  // namespace kinemend
