// Tests of the error figures of positions, against values computed by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::about_z;
using test::chain_clip;

TEST(Mpjpe, IsTheMeanDistanceOfJointPositions) {
  // In frame 0 the root turns by 90 degrees: joints at 0, 1, 2 along x move to y. Distances: 0,
  // sqrt 2, 2 sqrt 2.
  const Take reference = chain_clip(3, 2);
  Take other = reference;
  other.rotation(0, 0) = about_z(pi / 2);
  const double figure = 3 * std::sqrt(2.0) / 6;
  EXPECT_NEAR(mpjpe(reference, other), figure, 1e-12);
  EXPECT_NEAR(mpjpe(reference, other, 0, 2.54), 2.54 * figure, 1e-12);
  EXPECT_NEAR(mpjpe(reference, other, 1), 0, 1e-12);
}

TEST(Mpjpe, SeesTheRootsPosition) {
  const Take reference = chain_clip(3, 2);
  Take other = reference;
  for (std::size_t f = 0; f < 2; ++f) other.root_position(f) += Vec3{0, 3, 4};
  EXPECT_NEAR(mpjpe(reference, other), 5, 1e-12);
}

TEST(AccelError, IsTheMeanNormOfTheDifferenceOfSecondDerivatives) {
  // Frames 0 to 3; the root of the other take is off by 1 in frame 1. Second differences of the
  // error: -2, 1 at 10 Hz.
  const Take reference = chain_clip(2, 4, 10);
  Take other = reference;
  other.root_position(1) += Vec3{0, 1, 0};
  EXPECT_NEAR(accel_error(reference, other), 100 * (2.0 + 1.0) / 2, 1e-10);
  EXPECT_NEAR(accel_error(reference, other, 2), 0, 1e-12) << "two frames have no second derivative";
}

TEST(AccelError, IsZeroForAConstantSpeed) {
  const Take reference = chain_clip(2, 6);
  Take other = reference;
  for (std::size_t f = 0; f < 6; ++f) other.root_position(f).x += 0.5 * static_cast<double>(f);
  EXPECT_NEAR(accel_error(reference, other), 0, 1e-9);
}

TEST(RmsePerMarker, HasAMeanAndADeviationOverFrames) {
  // Two markers, three frames; distances (3, 4), (0, 0), (0, 5).
  const std::vector<Vec3> reference(6);
  const std::vector<Vec3> other{{3, 0, 0}, {0, 4, 0}, {}, {}, {}, {0, 0, 5}};
  const double a = std::sqrt(12.5), b = 0, c = std::sqrt(12.5), mean = 2 * a / 3;
  const double deviation =
      std::sqrt(((a - mean) * (a - mean) + (b - mean) * (b - mean) + (c - mean) * (c - mean)) / 3);
  const auto figure = rmse_per_marker(reference, other, 2);
  EXPECT_NEAR(figure.mean, mean, 1e-12);
  EXPECT_NEAR(figure.deviation, deviation, 1e-12);
}

TEST(RmsePerMarker, DividesByTheNumberOfNoisyMarkers) {
  const std::vector<Vec3> reference(6);
  const std::vector<Vec3> other{{3, 0, 0}, {0, 4, 0}, {}, {}, {}, {0, 0, 5}};
  const std::vector<std::uint8_t> noisy{1, 1, 0, 0, 0, 1};
  const auto figure = rmse_per_marker(reference, other, 2, noisy);
  EXPECT_NEAR(figure.mean, (std::sqrt(12.5) + 5) / 2, 1e-12);
  EXPECT_THROW(rmse_per_marker(reference, other, 4), Error);
  EXPECT_THROW(rmse_per_marker(reference, std::span(other).first(4), 2), Error);
}

TEST(RmsePerMarker, OfClipsIsInMetres) {
  const Take reference = chain_clip(3, 2);
  Take other = reference;
  other.rotation(0, 0) = about_z(pi / 2);  // squared distances 0, 2, 8
  const auto figure = rmse_per_marker_m(reference, other, 0.01);
  EXPECT_NEAR(figure.mean, 0.01 * std::sqrt(10.0 / 3) / 2, 1e-14);
  EXPECT_NEAR(figure.deviation, 0.01 * std::sqrt(10.0 / 3) / 2, 1e-14);
}

}  // namespace
}  // namespace kinemend
