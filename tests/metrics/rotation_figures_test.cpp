// Tests of the error figures of rotations, against values computed by hand.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::about_x;
using test::about_y;
using test::about_z;
using test::chain_clip;
using test::degree;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Three joints, two frames: in the reference, joint 1 turns about z and joint 2 about x, and
// nothing else moves.
Take two_frame_reference() {
  Take clip = chain_clip(3, 2);
  clip.rotation(1, 0) = about_y(40 * degree);
  clip.rotation(1, 1) = about_z(20 * degree);
  clip.rotation(1, 2) = about_x(30 * degree);
  return clip;
}

TEST(RmsDeg, IsTheRootMeanSquareOverMovingChannelsAveragedOverFrames) {
  const Take reference = two_frame_reference();
  Take other = reference;
  other.rotation(0, 1) = about_z(3 * degree);
  other.rotation(0, 2) = about_x(4 * degree);
  other.rotation(1, 1) = about_z(21 * degree);
  // Two channels move. Frame 0: sqrt((9 + 16) / 2); frame 1: sqrt(1 / 2).
  const double frame0 = std::sqrt(12.5), frame1 = std::sqrt(0.5);
  const auto figures = rms_deg_per_frame(reference, other);
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_NEAR(figures[0], frame0, 1e-10);
  EXPECT_NEAR(figures[1], frame1, 1e-10);
  EXPECT_NEAR(rms_deg(reference, other), (frame0 + frame1) / 2, 1e-10);
  EXPECT_NEAR(rms_deg(reference, other, 1), 0.0, 1e-10) << "with one frame nothing moves";
}

TEST(RmsDeg, LeavesOutTheRootAndChannelsThatDoNotMove) {
  const Take reference = two_frame_reference();
  Take other = reference;
  other.rotation(0, 0) = about_x(50 * degree);
  other.rotation(0, 1) = about_x(10 * degree);  // the x channel of joint 1 rests in the reference
  EXPECT_NEAR(rms_deg(reference, other), 0.0, 1e-10);
}

TEST(RmsDeg, WrapsDifferencesThatCrossAHalfTurn) {
  Take reference = two_frame_reference();
  reference.rotation(0, 1) = about_z(179 * degree);
  reference.rotation(1, 1) = about_z(170 * degree);
  Take other = reference;
  other.rotation(0, 1) = about_z(-179 * degree);
  EXPECT_NEAR(rms_deg_per_frame(reference, other)[0], 2 / std::sqrt(2.0), 1e-9);
}

TEST(RmsDeg, DoesNotMistakeAnotherEulerBranchForADifference) {
  // ZXY with the x angle above 90 degrees in the reference. Equal rotations must give 0, and 1
  // degree about y must give 1 degree.
  Take reference = chain_clip(2, 20), other = reference;
  const RotationOrder order = parse_rotation_order("ZXY");
  for (std::size_t f = 0; f < 20; ++f) {
    const double t = static_cast<double>(f);
    const std::array<double, 3> angles{0.1 * t, (80.5 + t) * degree, 0.05 * t};
    reference.rotation(f, 1) = from_euler(angles, order);
    other.rotation(f, 1) = from_euler({angles[0], angles[1], angles[2] + degree}, order);
  }
  EXPECT_NEAR(rms_deg(reference, reference), 0.0, 1e-9);
  EXPECT_NEAR(rms_deg(reference, other), 1 / std::sqrt(3.0), 1e-6);
}

TEST(RmsDeg, IgnoresTheSignOfQuaternions) {
  const Take reference = two_frame_reference();
  Take other = reference;
  for (Quat& q : other.rotations) q = -q;
  EXPECT_NEAR(rms_deg(reference, other), 0.0, 1e-10);
  EXPECT_NEAR(geodesic_rms_deg(reference, other), 0.0, 1e-10);
}

// Angles 3, 0, 0 in frame 0 and 0, 4, 12 in frame 1, about mixed axes.
Take geodesic_example(const Take& reference) {
  Take other = reference;
  other.rotation(0, 0) = reference.rotation(0, 0) * about_x(3 * degree);
  other.rotation(1, 1) = reference.rotation(1, 1) * about_y(4 * degree);
  other.rotation(1, 2) = reference.rotation(1, 2) * exp(12 * degree * Vec3{0.6, 0, 0.8});
  return other;
}

TEST(GeodesicRms, CountsEveryJointAndFrameTheRootIncluded) {
  const Take reference = two_frame_reference();
  const Take other = geodesic_example(reference);
  EXPECT_NEAR(geodesic_rms_deg(reference, other), std::sqrt((9.0 + 16 + 144) / 6), 1e-10);
  EXPECT_NEAR(geodesic_rms_deg(reference, other, 1), std::sqrt((16.0 + 144) / 3), 1e-10);
}

TEST(GeodesicRms, IsGivenJointByJoint) {
  const Take reference = two_frame_reference();
  const auto figures = geodesic_rms_deg_per_joint(reference, geodesic_example(reference));
  ASSERT_EQ(figures.size(), 3u);
  EXPECT_NEAR(figures[0], 3 / std::sqrt(2.0), 1e-10);
  EXPECT_NEAR(figures[1], 4 / std::sqrt(2.0), 1e-10);
  EXPECT_NEAR(figures[2], 12 / std::sqrt(2.0), 1e-10);
}

TEST(GeodesicPercentile, InterpolatesLinearly) {
  const Take reference = two_frame_reference();
  const Take other = geodesic_example(reference);
  // Sorted: 0 0 0 3 4 12. In numpy.percentile, 99 is position 4.95, 70 is 3.5, 100 is 12, and 0 is
  // 0.
  EXPECT_NEAR(geodesic_percentile_deg(reference, other), 4 + 0.95 * 8, 1e-10);
  EXPECT_NEAR(geodesic_percentile_deg(reference, other, 70), 3.5, 1e-10);
  EXPECT_NEAR(geodesic_percentile_deg(reference, other, 100), 12, 1e-10);
  EXPECT_NEAR(geodesic_percentile_deg(reference, other, 0), 0, 1e-10);
  EXPECT_THAT([&] { geodesic_percentile_deg(reference, other, 101); },
              ThrowsMessage<Error>(HasSubstr("percentile 101 is outside 0 to 100")));
}

TEST(PsnrDb, OfAClipWithBrokenValuesIsNoNumber) {
  const Take reference = chain_clip(2, 2);
  Take other = reference;
  other.rotation(1, 1).x = std::nan("");
  EXPECT_TRUE(std::isnan(psnr_db(reference, other)));
}

TEST(PsnrDb, ComparesPeakAndMeanSquareOfHalfTheRotationVector) {
  // One joint of two in one frame of two turns by 0.4 rad: half vector 0.2; MSE 0.04 / (2 * 2 * 3).
  const Take reference = chain_clip(2, 2);
  Take other = reference;
  other.rotation(1, 1) = exp({0, 0.4, 0});
  const double mse = 0.04 / 12;
  EXPECT_NEAR(psnr_db(reference, other, 0, 1.0), 10 * std::log10(1 / mse), 1e-9);
  EXPECT_NEAR(psnr_db(reference, other), 10 * std::log10(pi * pi / 4 / mse), 1e-9);
  EXPECT_NEAR(psnr_db(reference, other, 0, 10.0) - psnr_db(reference, other, 0, 1.0), 20, 1e-9);
  EXPECT_EQ(psnr_db(reference, reference), std::numeric_limits<double>::infinity());
  EXPECT_THROW(psnr_db(reference, other, 0, 0.0), Error);
}

TEST(MseRad2, DividesTheSumOfNPlusOneTermsByN) {
  const std::vector<Quat> reference{about_x(0.1), about_y(0.2), about_z(3.0)};
  const std::vector<Quat> other{about_x(0.4), about_y(0.2), about_z(3.0 + 0.5)};
  EXPECT_NEAR(mse_rad2(reference, other), (0.09 + 0.25) / 2, 1e-12);
  EXPECT_NEAR(mse_rad2(std::span(reference).first(1), std::span(other).first(1)), 0.09, 1e-12);
  EXPECT_THROW(mse_rad2(reference, std::span(other).first(2)), Error);
}

TEST(MseRad2, OfClipsIsTheMeanOverJoints) {
  const Take reference = chain_clip(2, 3);
  Take other = reference;
  other.rotation(0, 0) = about_x(0.3);
  other.rotation(2, 1) = about_z(0.5);
  EXPECT_NEAR(mse_rad2(reference, other), (0.09 / 2 + 0.25 / 2) / 2, 1e-12);
  EXPECT_NEAR(mse_rad2(reference, other, 1), 0.25 / 2, 1e-12);
}

TEST(PeakAngularSpeed, IsTheLargestStepTimesTheRate) {
  Take clip = chain_clip(2, 4, 120);
  clip.rotation(0, 1) = about_x(50 * degree);
  clip.rotation(2, 1) = about_x(3 * degree);
  clip.rotation(3, 1) = about_x(1 * degree);
  const auto peaks = peak_angular_speed_deg_s(clip);
  EXPECT_NEAR(peaks[0], 0, 1e-12);
  EXPECT_NEAR(peaks[1], 50 * 120, 1e-8);
  EXPECT_NEAR(peak_angular_speed_deg_s(clip, 1)[1], 3 * 120, 1e-8);
  EXPECT_EQ(peak_angular_speed_deg_s(chain_clip(2, 1)), (std::vector<double>{0, 0}));
}

}  // namespace
}  // namespace kinemend
