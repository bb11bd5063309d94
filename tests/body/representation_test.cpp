// Tests of the channels that encode rotations: decoding is exact, and half a turn causes no jump.
#include "kinemend/extend/body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/error.hpp"
#include "motion/random_rotations.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

// A chain of `joints` three-axis joints that rests for `frames` frames.
Take chain(std::size_t joints, std::size_t frames) {
  Take clip;
  for (std::size_t j = 0; j < joints; ++j) {
    clip.skeleton.add_joint("joint" + std::to_string(j), static_cast<std::int32_t>(j) - 1,
                            {0, 10, 0}, make_channels(j == 0, parse_rotation_order("ZXY")));
  }
  clip.frame_rate_hz = 120;
  clip.positions.assign(frames, {});
  clip.rotations.assign(frames * joints, {});
  return clip;
}

double largest_difference(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rotations.size(); ++i) {
    largest = std::max(largest, angle_between(a.rotations[i], b.rotations[i]));
  }
  return largest;
}

Take emptied(const Take& clip) {
  Take copy = clip;
  copy.rotations.assign(clip.rotations.size(), {});
  copy.positions.assign(clip.positions.size(), {});
  return copy;
}

double round_trip_error(const Take& clip, Encoding encoding) {
  Take back = emptied(clip);
  decode(encode(clip, encoding), back);
  return largest_difference(clip, back);
}

// One joint that turns about a slanted axis from `start` in equal steps (radians).
Take turning(double start, double step, std::size_t frames) {
  Take clip = chain(1, frames);
  const Vec3 axis{2.0 / 7, 3.0 / 7, 6.0 / 7};
  for (std::size_t f = 0; f < frames; ++f)
    clip.rotation(f, 0) = exp((start + step * static_cast<double>(f)) * axis);
  return clip;
}

double largest_step(const EncodedClip& encoded, std::size_t joint) {
  const std::size_t width = encoded.channels_per_joint();
  double largest = 0;
  for (std::size_t f = 1; f < encoded.poses.frames; ++f) {
    double sum = 0;
    for (std::size_t c = joint * width; c < (joint + 1) * width; ++c) {
      sum += std::pow(encoded.poses(f, c) - encoded.poses(f - 1, c), 2);
    }
    largest = std::max(largest, std::sqrt(sum));
  }
  return largest;
}

TEST(Representation, RandomRotationsComeBackExactly) {
  Random random(1);
  Take clip = chain(5, 200);
  for (Quat& q : clip.rotations) q = test::random_rotation(random);
  EXPECT_LT(round_trip_error(clip, Encoding::tangent), 1e-12);
  EXPECT_LT(round_trip_error(clip, Encoding::quaternion), 1e-12);
}

TEST(Representation, TurnsThroughPiAndManyTimesRoundComeBackExactly) {
  for (const double step : {0.03, 0.2, -0.11, 3.0}) {
    const Take clip = turning(-1, step, 400);
    EXPECT_LT(round_trip_error(clip, Encoding::tangent), 1e-12) << step;
    EXPECT_LT(round_trip_error(clip, Encoding::quaternion), 1e-12) << step;
  }
}

TEST(Representation, ExactlyPiAndExactlyNothingComeBackExactly) {
  Take clip = chain(1, 4);
  clip.rotation(1, 0) = {0, 1, 0, 0};
  clip.rotation(2, 0) = {0, -0.6, 0.8, 0};
  clip.rotation(3, 0) = {-1, 0, 0, 0};
  EXPECT_LT(round_trip_error(clip, Encoding::tangent), 1e-12);
  EXPECT_LT(round_trip_error(clip, Encoding::quaternion), 1e-12);
}

TEST(Representation, ATangentChannelOfASteadyTurnIsAStraightLineThroughPiAndBeyond) {
  const double step = 0.05;
  Take clip = chain(1, 500);  // holds still for 400 frames, then turns by 5 rad
  const Take turn = turning(0.4, step, 101);
  for (std::size_t f = 0; f < 500; ++f)
    clip.rotation(f, 0) = turn.rotation(f < 400 ? 0 : f - 399, 0);
  const EncodedClip encoded = encode(clip, Encoding::tangent);
  EXPECT_GT(norm(Vec3{encoded.poses(499, 0), encoded.poses(499, 1), encoded.poses(499, 2)}),
            pi + 1);
  for (std::size_t f = 400; f < 500; ++f) {
    EXPECT_NEAR(encoded.poses(f, 0) - encoded.poses(f - 1, 0), step * 2 / 7, 1e-9);
    EXPECT_NEAR(encoded.poses(f, 2) - encoded.poses(f - 1, 2), step * 6 / 7, 1e-9);
  }
}

TEST(Representation, NoisyChannelsHaveNoJumpWherePiIsPassed) {
  Random random(3);
  Take clip = chain(1, 600);
  for (std::size_t f = 0; f < 600;
       ++f) {  // swings 200 degrees either way, 1 degree of noise about every axis
    const double yaw =
        200 * radians_per_degree * std::pow(std::sin(static_cast<double>(f) * 0.02), 3);
    const Vec3 noise{random.normal(), random.normal(), random.normal()};
    clip.rotation(f, 0) = exp({0, yaw, 0}) * exp(radians_per_degree * noise);
  }
  EXPECT_LT(largest_step(encode(clip, Encoding::tangent), 0), 0.5);
  EXPECT_LT(largest_step(encode(clip, Encoding::quaternion), 0), 0.2);
  EXPECT_LT(round_trip_error(clip, Encoding::tangent), 1e-12);
}

TEST(Representation, AContinuedVectorIsTheNearestOfAllThatMeanTheSame) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 v = log(test::random_rotation(random));
    const Vec3 previous{5 * random.normal(), 5 * random.normal(), 5 * random.normal()};
    const double found = norm(continue_rotation_vector(v, previous) - previous);
    double best = 1e9;
    for (int k = -6; k <= 6; ++k) {
      best = std::min(best, norm((1 + 2 * pi * k / norm(v)) * v - previous));
    }
    EXPECT_NEAR(found, best, 1e-9);
  }
  EXPECT_EQ(continue_rotation_vector({}, {0, 1, 0}), (Vec3{}));
  EXPECT_NEAR(continue_rotation_vector({}, {0, 6, 0}).y, 2 * pi, 1e-12);
}

TEST(Representation, TheSignOfAQuaternionDoesNotMatter) {
  Random random(5);
  Take clip = turning(0, 0.05, 100);
  Take flipped = clip;
  for (Quat& q : flipped.rotations) {
    if (random.chance(0.5)) q = -q;
  }
  for (const Encoding encoding : {Encoding::tangent, Encoding::quaternion}) {
    const PoseMatrix a = encode(clip, encoding).poses, b = encode(flipped, encoding).poses;
    for (std::size_t i = 0; i < a.values.size(); ++i)
      ASSERT_NEAR(std::fabs(a.values[i]), std::fabs(b.values[i]), 1e-12);
  }
}

TEST(Representation, FramesThrownFarOffDoNotTurnTheSignOfWhatFollows) {
  Random random(11);
  const Take clean = turning(0, 0.02, 300);
  for (int trial = 0; trial < 20; ++trial) {
    Take clip = clean;
    for (std::size_t f = 1; f < 300; ++f) {
      if (random.chance(0.1)) clip.rotation(f, 0) = test::random_rotation(random);
    }
    const EncodedClip encoded = encode(clip, Encoding::quaternion);
    for (std::size_t f = 0; f < 300; ++f) {  // this turn's own quaternion is already continuous
      if (angle_between(clip.rotation(f, 0), clean.rotation(f, 0)) > 1e-6) continue;
      ASSERT_NEAR(encoded.poses(f, 0), clean.rotation(f, 0).w, 1e-12) << trial << " " << f;
    }
  }
}

TEST(Representation, ALongStayFarOffIsTheNewMotion) {
  SignContinuation signs;
  signs.next({1, 0, 0, 0});
  for (int f = 0; f < 100; ++f) signs.next({0.1, std::sqrt(0.99), 0, 0});
  EXPECT_GT(signs.next({-0.1, std::sqrt(0.99), 0, 0}).x, 0);
}

TEST(Representation, PositionsComeLastAboutTheirMeanAndComeBack) {
  Take clip = chain(3, 10);
  test::add_translations(clip, {2}, Vec3{});
  Random random(6);
  for (std::size_t f = 0; f < 10; ++f) {
    clip.root_position(f) = {1000 + random.normal(), -500 + random.normal(), random.normal()};
    clip.position(f, 1) = {random.normal(), 7, -7};
  }
  const EncodedClip encoded = encode(clip, Encoding::quaternion, {1});
  ASSERT_EQ(encoded.poses.channels, 4U + 6U);
  double sum = 0;
  for (std::size_t f = 0; f < 10; ++f) sum += encoded.poses(f, 4);
  EXPECT_NEAR(sum, 0, 1e-9);
  EXPECT_NEAR(encoded.poses(3, 4) + encoded.position_references[0].x, clip.root_position(3).x,
              1e-9);
  Take back = emptied(clip);
  decode(encoded, back);
  for (std::size_t f = 0; f < 10; ++f) {
    EXPECT_LT(norm(back.root_position(f) - clip.root_position(f)), 1e-12 * 1000);
    EXPECT_LT(norm(back.position(f, 1) - clip.position(f, 1)), 1e-12);
  }
}

TEST(Representation, DecodingTouchesNothingThatWasNotEncoded) {
  Random random(7);
  Take clip = chain(3, 5);
  for (Quat& q : clip.rotations) q = test::random_rotation(random);
  EncodedClip encoded = encode(clip, Encoding::tangent, {1}, false);
  for (double& v : encoded.poses.values) v = 0.1;
  Take changed = clip;
  decode(encoded, changed);
  for (std::size_t f = 0; f < 5; ++f) {
    EXPECT_EQ(changed.rotation(f, 0), clip.rotation(f, 0));
    EXPECT_NE(changed.rotation(f, 1), clip.rotation(f, 1));
    EXPECT_EQ(changed.rotation(f, 2), clip.rotation(f, 2));
  }
  EXPECT_EQ(changed.positions, clip.positions);
}

TEST(Representation, TheReferenceIsTheMeanOfWhatWasObserved) {
  Take clip = chain(1, 4);
  clip.rotation(0, 0) = exp({0.1, 0, 0});
  clip.rotation(1, 0) = exp({0, 3, 0});
  clip.rotation(2, 0) = exp({0.3, 0, 0});
  clip.rotation(3, 0) = -exp({0.2, 0, 0});
  clip.observed = {1, 0, 1, 1};
  EXPECT_LT(angle_between(mean_rotation(clip, 0), exp({0.2, 0, 0})), 1e-9);
  clip.observed = {0, 0, 0, 0};
  EXPECT_LT(angle_between(mean_rotation(clip, 0), exp({0.1, 0, 0})), 1e-9);
}

TEST(Representation, AJointThatLeavesItsHalfTurnIsGivenQuaternions) {
  EXPECT_EQ(suitable_encoding(turning(0, 0.01, 100), 0), Encoding::tangent);
  EXPECT_EQ(suitable_encoding(turning(0, 0.1, 100), 0), Encoding::quaternion);
  EXPECT_NEAR(largest_angle_from_mean(turning(0, 0.01, 101), 0), 0.5, 1e-6);
}

TEST(Representation, EmptyClipsAndOneFrameComeThrough) {
  for (const std::size_t frames : {std::size_t{0}, std::size_t{1}}) {
    const Take clip = chain(2, frames);
    EXPECT_EQ(round_trip_error(clip, Encoding::tangent), 0);
    EXPECT_EQ(round_trip_error(clip, Encoding::quaternion), 0);
  }
}

TEST(Representation, WhatDoesNotFitIsRefused) {
  const Take clip = chain(2, 5);
  EXPECT_THROW(encode(clip, Encoding::tangent, {2}), Error);
  Take other = chain(2, 6);
  EXPECT_THROW(decode(encode(clip, Encoding::tangent), other), Error);
  Take smaller = chain(1, 5);
  EXPECT_THROW(decode(encode(clip, Encoding::tangent), smaller), Error);
}

}  // namespace
}  // namespace kinemend
