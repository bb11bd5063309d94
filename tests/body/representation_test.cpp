// Tests of the channels that encode rotations: decoding is exact, and half a turn causes no jump.
#include "body/representation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/random_rotations.hpp"

namespace kinemend {
namespace {

using Rotations = std::vector<Quat>;

PoseMatrix encoded(const Rotations& track, Encoding encoding) {
  PoseMatrix channels(track.size(), channels_of(encoding));
  encode_rotations(track, encoding, mean_rotation(track, {}), channels, 0);
  return channels;
}

double round_trip_error(const Rotations& track, Encoding encoding) {
  const PoseMatrix channels = encoded(track, encoding);
  const Quat reference = mean_rotation(track, {});
  double largest = 0;
  for (std::size_t f = 0; f < track.size(); ++f) {
    const Quat back = decode_rotation(channels, encoding, reference, f, 0);
    largest = std::max(largest, angle_between(track[f], back));
  }
  return largest;
}

void expect_exact(const Rotations& track) {
  EXPECT_LT(round_trip_error(track, Encoding::tangent), 1e-12);
  EXPECT_LT(round_trip_error(track, Encoding::quaternion), 1e-12);
}

// A turn about a slanted axis from `start` in equal steps (radians).
Rotations turning(double start, double step, std::size_t frames) {
  const Vec3 axis{2.0 / 7, 3.0 / 7, 6.0 / 7};
  Rotations track;
  for (std::size_t f = 0; f < frames; ++f)
    track.push_back(exp((start + step * static_cast<double>(f)) * axis));
  return track;
}

double largest_step(const PoseMatrix& poses) {
  double largest = 0;
  for (std::size_t f = 1; f < poses.frames; ++f) {
    double sum = 0;
    for (std::size_t c = 0; c < poses.channels; ++c)
      sum += std::pow(poses(f, c) - poses(f - 1, c), 2);
    largest = std::max(largest, std::sqrt(sum));
  }
  return largest;
}

TEST(Representation, RandomRotationsComeBackExactly) {
  Random random(1);
  Rotations track(200);
  for (Quat& q : track) q = test::random_rotation(random);
  expect_exact(track);
}

TEST(Representation, TurnsThroughPiAndManyTimesRoundComeBackExactly) {
  for (const double step : {0.03, 0.2, -0.11, 3.0}) expect_exact(turning(-1, step, 400));
}

TEST(Representation, ExactlyPiAndExactlyNothingComeBackExactly) {
  expect_exact({{}, {0, 1, 0, 0}, {0, -0.6, 0.8, 0}, {-1, 0, 0, 0}});
}

TEST(Representation, NoFrameAndOneFrameComeBackExactly) {
  for (const std::size_t frames : {std::size_t{0}, std::size_t{1}}) expect_exact(Rotations(frames));
}

TEST(Representation, ATangentChannelOfASteadyTurnIsAStraightLineThroughPiAndBeyond) {
  const double step = 0.05;
  Rotations track = turning(0.4, 0, 399);  // holds still, then turns by 5 rad
  for (const Quat q : turning(0.4, step, 101)) track.push_back(q);
  const PoseMatrix poses = encoded(track, Encoding::tangent);
  EXPECT_GT(norm(Vec3{poses(499, 0), poses(499, 1), poses(499, 2)}), pi + 1);
  for (std::size_t f = 400; f < 500; ++f) {
    EXPECT_NEAR(poses(f, 0) - poses(f - 1, 0), step * 2 / 7, 1e-9);
    EXPECT_NEAR(poses(f, 2) - poses(f - 1, 2), step * 6 / 7, 1e-9);
  }
}

TEST(Representation, NoisyChannelsHaveNoJumpWherePiIsPassed) {
  Random random(3);
  Rotations track;  // swings 200 degrees either way, 1 degree of noise about every axis
  for (std::size_t f = 0; f < 600; ++f) {
    const double yaw =
        200 * radians_per_degree * std::pow(std::sin(static_cast<double>(f) * 0.02), 3);
    const Vec3 noise{random.normal(), random.normal(), random.normal()};
    track.push_back(exp({0, yaw, 0}) * exp(radians_per_degree * noise));
  }
  EXPECT_LT(largest_step(encoded(track, Encoding::tangent)), 0.5);
  EXPECT_LT(largest_step(encoded(track, Encoding::quaternion)), 0.2);
  EXPECT_LT(round_trip_error(track, Encoding::tangent), 1e-12);
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
  const Rotations track = turning(0, 0.05, 100);
  Rotations flipped = track;
  for (Quat& q : flipped) {
    if (random.chance(0.5)) q = -q;
  }
  for (const Encoding encoding : {Encoding::tangent, Encoding::quaternion}) {
    const PoseMatrix a = encoded(track, encoding), b = encoded(flipped, encoding);
    for (std::size_t i = 0; i < a.values.size(); ++i)
      ASSERT_NEAR(std::fabs(a.values[i]), std::fabs(b.values[i]), 1e-12);
  }
}

TEST(Representation, FramesThrownFarOffDoNotTurnTheSignOfWhatFollows) {
  Random random(11);
  const Rotations clean = turning(0, 0.02, 300);
  for (int trial = 0; trial < 20; ++trial) {
    Rotations track = clean;
    for (std::size_t f = 1; f < 300; ++f) {
      if (random.chance(0.1)) track[f] = test::random_rotation(random);
    }
    const PoseMatrix poses = encoded(track, Encoding::quaternion);
    for (std::size_t f = 0; f < 300; ++f) {  // this turn's own quaternion is already continuous
      if (angle_between(track[f], clean[f]) > 1e-6) continue;
      ASSERT_NEAR(poses(f, 0), clean[f].w, 1e-12) << trial << " " << f;
    }
  }
}

TEST(Representation, ALongStayFarOffIsTheNewMotion) {
  SignContinuation signs;
  signs.next({1, 0, 0, 0});
  for (int f = 0; f < 100; ++f) signs.next({0.1, std::sqrt(0.99), 0, 0});
  EXPECT_GT(signs.next({-0.1, std::sqrt(0.99), 0, 0}).x, 0);
}

TEST(Representation, TheReferenceIsTheMeanOfWhatWasObserved) {
  const Rotations track{exp({0.1, 0, 0}), exp({0, 3, 0}), exp({0.3, 0, 0}), -exp({0.2, 0, 0})};
  const std::vector<std::uint8_t> some{1, 0, 1, 1}, none{0, 0, 0, 0};
  EXPECT_LT(angle_between(mean_rotation(track, some), exp({0.2, 0, 0})), 1e-9);
  EXPECT_LT(angle_between(mean_rotation(track, none), exp({0.1, 0, 0})), 1e-9);
}

TEST(Representation, AJointThatLeavesItsHalfTurnIsGivenQuaternions) {
  EXPECT_EQ(suitable_encoding(turning(0, 0.01, 100), {}), Encoding::tangent);
  EXPECT_EQ(suitable_encoding(turning(0, 0.1, 100), {}), Encoding::quaternion);
}

}  // namespace
}  // namespace kinemend
