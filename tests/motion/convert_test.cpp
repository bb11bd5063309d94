// Tests of conversions to other rates, axes, units and kinds.
#include "kinemend/extend/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/error.hpp"
#include "motion/clips.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

using test::moving_chain;
using test::random_rotation;
using test::random_vector;

void expect_near(Vec3 a, Vec3 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// A chain with rest rotations, bones in all directions, a hinge, and a translated joint.
Take crooked_clip(std::uint64_t seed) {
  Random random(seed);
  Take clip = moving_chain(5, 40);
  for (std::size_t j = 0; j < 5; ++j) {
    clip.skeleton.rest_rotations[j] = random_rotation(random);
    clip.skeleton.offsets[j] = random_vector(random);
  }
  clip.skeleton.channels[3] = {Channel::y_rotation};
  clip.skeleton.channels[4] = make_channels(true, parse_rotation_order("XYZ"));
  test::add_translations(clip, {4},
                         [&](std::size_t, std::size_t) { return random_vector(random); });
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.rotation(f, 3) = exp({0, 0.01 * static_cast<double>(f), 0});
  clip.metres_per_unit = 0.01;
  clip.validate();
  return clip;
}

Take line_of_markers(std::size_t frames, double rate) {
  Take clip = make_marker_take({"A", "B"}, frames, rate);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / rate;
    clip.position(f, 0) = {t, 2 * t, 1};
    clip.position(f, 1) = {std::sin(t), std::cos(t), t * t};
    clip.observed[2 * f] = clip.observed[2 * f + 1] = 1;
  }
  return clip;
}

TEST(Resample, AtHalfTheRateKeepsEverySecondFrameAsItIs) {
  const Take clip = moving_chain(4, 21, 120);
  const Take half = resample(clip, 60);
  ASSERT_EQ(half.frame_count(), 11u);
  EXPECT_EQ(half.frame_rate_hz, 60);
  for (std::size_t f = 0; f < 11; ++f) {
    EXPECT_EQ(half.root_position(f), clip.root_position(2 * f));
    for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(half.rotation(f, j), clip.rotation(2 * f, j));
  }
}

TEST(Resample, ToTwiceTheRateAndBackIsTheSameClip) {
  const Take clip = moving_chain(4, 21, 100);
  const Take again = resample(resample(clip, 200), 100);
  EXPECT_EQ(again.rotations, clip.rotations);
  EXPECT_EQ(again.positions, clip.positions);
}

TEST(Resample, FollowsASmoothMotionBetweenItsFrames) {
  const Take clip = moving_chain(4, 101, 100), fine = moving_chain(4, 161, 160);
  const Take result = resample(clip, 160);
  ASSERT_EQ(result.frame_count(), 161u);
  for (std::size_t f = 2; f < 158; ++f) {
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_LT(angle_between(result.rotation(f, j), fine.rotation(f, j)), 2e-5);
    expect_near(result.root_position(f), fine.root_position(f), 2e-5);
  }
}

TEST(Resample, TakesStraightMotionStraightOnAtTheEnds) {
  const Take fine = resample(line_of_markers(3, 10), 40);
  for (std::size_t f = 0; f < fine.frame_count(); ++f) {
    const double t = static_cast<double>(f) / 40;
    expect_near(fine.position(f, 0), {t, 2 * t, 1}, 1e-12);
  }
}

TEST(Resample, ObservesASampleOnlyBetweenTwoThatWereObserved) {
  Take clip = line_of_markers(6, 10);
  clip.observed[2 * 3] = 0;  // marker A in frame 3
  clip.position(3, 0) = {1e30, 1e30, 1e30};
  const Take fine = resample(clip, 20);
  for (std::size_t f = 0; f < fine.frame_count(); ++f) {
    EXPECT_EQ(fine.is_observed(f, 0), f <= 4 || f >= 8) << f;
    EXPECT_TRUE(fine.is_observed(f, 1));
    if (fine.is_observed(f, 0)) {
      EXPECT_LT(norm(fine.position(f, 0)), 10) << f;
    }
  }
}

TEST(Resample, LeavesATakeAtItsOwnRateAlone) {
  const auto document = std::make_shared<const SourceDocument>();
  Take markers = line_of_markers(6, 119.88012);
  markers.source.document = document;
  markers.first_frame = 7;
  Take joints = moving_chain(2, 10);
  joints.source.document = document;
  for (const double rate : {119.88012, 119.88}) {
    const Take same = resample(markers, rate);
    EXPECT_EQ(same.source.document, document);
    EXPECT_EQ(same.positions, markers.positions);
    EXPECT_EQ(same.frame_rate_hz, markers.frame_rate_hz);
    EXPECT_EQ(same.first_frame, 7);
  }
  EXPECT_EQ(resample(markers, 119.8).source.document, nullptr);
  EXPECT_EQ(resample(joints, joints.frame_rate_hz).source.document, document);
  EXPECT_EQ(scale_lengths(markers, 1, "m").source.document, document);
  EXPECT_EQ(scale_lengths(joints, 1).source.document, document);
}

// The first frame's number is an integer; the events' times absorb the remainder.
TEST(Resample, LeavesEventsAtTheirMomentOfTheMotion) {
  Take clip = line_of_markers(20, 100);
  clip.events = {{"Foot Strike", "Left", 0.5}};
  for (const std::int64_t first : {0, 1, 2, 11, 480}) {
    clip.first_frame = first;
    for (const double rate : {25.0, 50.0, 60.0, 240.0}) {
      const Take other = resample(clip, rate);
      const auto moment = [](const Take& take) {
        return take.events[0].time_s -
               static_cast<double>(take.first_frame - 1) / take.frame_rate_hz;
      };
      EXPECT_NEAR(moment(other), moment(clip), 1e-9) << first << " at " << rate;
      const double trial_s = static_cast<double>(first - 1) / 100;
      if (first > 0) {
        EXPECT_LE(std::fabs(static_cast<double>(other.first_frame - 1) / rate - trial_s),
                  0.5 / rate + 1e-9);
      }
    }
  }
}

TEST(Resample, RefusesRatesThatMakeNoSense) {
  const Take clip = moving_chain(2, 10);
  EXPECT_THROW(resample(clip, 0), Error);
  EXPECT_THROW(resample(clip, std::nan("")), Error);
  EXPECT_THROW(resample(clip, 1e12), Error);
  EXPECT_EQ(resample(moving_chain(2, 0), 50).frame_count(), 0u);
}

TEST(TurnAxes, TurnsEveryPositionOfTheBody) {
  const Take clip = crooked_clip(1);
  for (const Axis from : {Axis::x, Axis::y, Axis::z}) {
    for (const Axis to : {Axis::x, Axis::y, Axis::z}) {
      const Take turned = turn_axes(clip, from, to);
      turned.validate();
      const auto before = joint_positions(clip, true), after = joint_positions(turned, true);
      const Vec3 e_from{from == Axis::x ? 1. : 0., from == Axis::y ? 1. : 0.,
                        from == Axis::z ? 1. : 0.};
      const Vec3 e_to{to == Axis::x ? 1. : 0., to == Axis::y ? 1. : 0., to == Axis::z ? 1. : 0.};
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_NEAR(dot(before[i], e_from), dot(after[i], e_to), 1e-12);
        EXPECT_NEAR(norm(before[i]), norm(after[i]), 1e-12);
      }
    }
  }
}

TEST(TurnAxes, KeepsAHingeAHinge) {
  const Take turned = turn_axes(crooked_clip(2), Axis::y, Axis::z);
  ASSERT_EQ(turned.skeleton.channels[3], std::vector<Channel>{Channel::z_rotation});
  for (std::size_t f = 0; f < turned.frame_count(); ++f) {
    const Quat q = turned.rotation(f, 3);
    EXPECT_EQ(q.x, 0);
    EXPECT_EQ(q.y, 0);
  }
}

TEST(TurnAxes, ThereAndBackIsTheSameTakeToTheBit) {
  const Take clip = crooked_clip(3);
  const Take again = turn_axes(turn_axes(clip, Axis::y, Axis::z), Axis::z, Axis::y);
  EXPECT_EQ(again.rotations, clip.rotations);
  EXPECT_EQ(again.positions, clip.positions);
  EXPECT_EQ(again.skeleton.channels, clip.skeleton.channels);
  const Take markers = line_of_markers(5, 10);
  EXPECT_EQ(turn_axes(turn_axes(markers, Axis::z, Axis::x), Axis::x, Axis::z).positions,
            markers.positions);
}

TEST(TurnAxes, LeavesAnglesAndForcesAmongTheMarkersAlone) {
  Take clip = line_of_markers(5, 10);
  clip.is_position[1] = 0;
  const Take turned = turn_axes(clip, Axis::z, Axis::y);
  EXPECT_EQ(turned.position(3, 1), clip.position(3, 1));
  EXPECT_FALSE(turned.position(3, 0) == clip.position(3, 0));
}

TEST(WithoutRestRotations, MovesEveryJointAsBefore) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const Take clip = crooked_clip(seed);
    const Take plain = without_rest_rotations(clip);
    plain.validate();
    for (const Quat rest : plain.skeleton.rest_rotations) EXPECT_EQ(rest, Quat{});
    const auto before = joint_positions(clip, true), after = joint_positions(plain, true);
    for (std::size_t i = 0; i < before.size(); ++i) expect_near(before[i], after[i], 1e-9);
  }
}

TEST(WithoutRestRotations, GivesAHingeThreeAxes) {
  const Take plain = without_rest_rotations(crooked_clip(1));
  EXPECT_EQ(to_string(plain.skeleton.rotation_order(3)), "ZYX");
  EXPECT_EQ(to_string(plain.skeleton.rotation_order(1)), "ZXY");
}

TEST(JointMarkers, AreTheJointsPositions) {
  const Take clip = crooked_clip(7);
  const Take markers = joint_markers(clip, true);
  markers.validate();
  EXPECT_EQ(markers.unit, "cm");
  EXPECT_EQ(markers.positions, joint_positions(clip, true));
  EXPECT_EQ(markers.names.back(), "joint4_end");
}

TEST(JointMarkers, AreMissingBelowARotationThatIsMissing) {
  Take clip = moving_chain(4, 3);
  clip.observed.assign(12, 1);
  clip.observed[4 + 1] = 0;  // joint1 in frame 1
  const Take markers = joint_markers(clip, true);
  EXPECT_THAT(markers.observed, testing::ElementsAre(1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1));
}

TEST(ScaleLengths, ScalesPositionsAndKeepsAngles) {
  const Take clip = crooked_clip(4), large = scale_lengths(clip, 10);
  EXPECT_DOUBLE_EQ(large.metres_per_unit, 0.001);
  EXPECT_EQ(large.rotations, clip.rotations);
  const auto before = joint_positions(clip), after = joint_positions(large);
  for (std::size_t i = 0; i < before.size(); ++i) expect_near(10.0 * before[i], after[i], 1e-9);
}

TEST(GuessUpAxis, IsTheOneAlongWhichTheFloorStays) {
  Take clip = make_marker_take({"foot", "head"}, 100, 100);
  for (std::size_t f = 0; f < 100; ++f) {
    const double t = static_cast<double>(f) / 100;
    const Vec3 foot{3 * t, 2 * std::sin(3 * t), 0.1 * std::max(0.0, std::sin(20 * t))};
    clip.position(f, 0) = foot;
    clip.position(f, 1) = foot + Vec3{0.1 * t, 0.2 * std::sin(5 * t), 1.7 + 0.1 * std::sin(4 * t)};
    clip.observed[2 * f] = clip.observed[2 * f + 1] = 1;
  }
  EXPECT_EQ(guess_up_axis(clip), Axis::z);
  EXPECT_EQ(guess_up_axis(turn_axes(clip, Axis::z, Axis::y)), Axis::y);
  EXPECT_EQ(guess_up_axis(turn_axes(clip, Axis::z, Axis::x)), Axis::x);
}

}  // namespace
}  // namespace kinemend
