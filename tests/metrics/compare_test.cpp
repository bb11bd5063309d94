// Tests of each figure in the comparison of two clips.
#include <gmock/gmock.h>

#include <limits>

#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/metrics.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::about_x;
using test::chain_clip;
using test::degree;
using test::moving_chain;
using testing::AllOf;
using testing::HasSubstr;
using testing::Property;
using testing::Throws;
using testing::ThrowsMessage;

TEST(CompareClips, AgreesWithEachFigureAlone) {
  const Take reference = moving_chain(4, 30);
  Take other = reference;
  Random random(5);
  for (Quat& q : other.rotations) q = q * exp(test::random_vector(random, 0.05));
  ComparisonSettings settings;
  settings.first_frame = 2;
  settings.psnr_peak = 3;
  settings.metres_per_unit = 0.02;
  settings.foot_slide.joints = {2};
  const Comparison figures = compare_clips(reference, other, settings);
  EXPECT_EQ(figures.frames, 28u);
  EXPECT_GT(figures.rms_deg, 1);
  EXPECT_EQ(figures.rms_deg, rms_deg(reference, other, 2));
  EXPECT_EQ(figures.geodesic_rms_deg, geodesic_rms_deg(reference, other, 2));
  EXPECT_EQ(figures.geodesic_p99_deg, geodesic_percentile_deg(reference, other, 99, 2));
  EXPECT_EQ(figures.geodesic_max_deg, geodesic_percentile_deg(reference, other, 100, 2));
  EXPECT_EQ(figures.mpjpe, mpjpe(reference, other, 2));
  EXPECT_NEAR(figures.mpjpe_cm.value(), 2 * figures.mpjpe, 1e-12);
  EXPECT_EQ(figures.accel_error, accel_error(reference, other, 2));
  EXPECT_EQ(figures.psnr_db, psnr_db(reference, other, 2, 3));
  EXPECT_EQ(figures.psnr_peak, 3);
  EXPECT_EQ(figures.rmse_per_marker_m->mean, rmse_per_marker_m(reference, other, 0.02, 2).mean);
  EXPECT_EQ(figures.mse_rad2, mse_rad2(reference, other, 2));
  EXPECT_EQ(figures.foot_slide.per_frame,
            foot_slide(reference, other, settings.foot_slide, 2).per_frame);
  EXPECT_EQ(figures.foot_slide_reference.per_frame,
            foot_slide(reference, reference, settings.foot_slide, 2).per_frame);
  ASSERT_EQ(figures.joints.size(), 4u);
  EXPECT_EQ(figures.joints[3].geodesic_rms_deg, geodesic_rms_deg_per_joint(reference, other, 2)[3]);
}

TEST(CompareClips, LeavesTheCalibrationFrameOut) {
  const Take reference = moving_chain(3, 10);
  Take other = reference;
  other.rotation(0, 1) = about_x(100 * degree);
  EXPECT_GT(compare_clips(reference, other).geodesic_max_deg, 50);
  ComparisonSettings settings;
  settings.first_frame = 1;
  const Comparison figures = compare_clips(reference, other, settings);
  EXPECT_EQ(figures.geodesic_max_deg, 0);
  EXPECT_EQ(figures.mpjpe, 0);
  EXPECT_EQ(figures.psnr_db, std::numeric_limits<double>::infinity());
}

TEST(CompareClips, TellsNoCentimetresWhereTheScaleIsUnknown) {
  const Take clip = chain_clip(8, 3);  // 8 units long: not a person in any unit
  EXPECT_FALSE(compare_clips(clip, clip).mpjpe_cm);
  EXPECT_FALSE(compare_clips(clip, clip).rmse_per_marker_m);
}

TEST(CompareClips, RefusesClipsThatDoNotMatch) {
  const Take clip = chain_clip(3, 4);
  const auto usage = Throws<Error>(Property(&Error::kind, ErrorKind::usage));
  EXPECT_THAT([&] { compare_clips(clip, chain_clip(4, 4)); },
              AllOf(usage, ThrowsMessage<Error>("the clips differ in joints: 3 and 4")));
  EXPECT_THAT([&] { compare_clips(clip, chain_clip(3, 5)); },
              AllOf(usage, ThrowsMessage<Error>("the clips differ in frames: 4 and 5")));
  Take renamed = clip;
  renamed.skeleton.names[1] = "knee";
  EXPECT_THAT(
      [&] { compare_clips(clip, renamed); },
      ThrowsMessage<Error>("the clips differ in joints: joint 1 is \"joint1\" and \"knee\""));
  ComparisonSettings settings;
  settings.first_frame = 4;
  EXPECT_THAT(
      [&] { compare_clips(clip, clip, settings); },
      ThrowsMessage<Error>(HasSubstr("no frames to compare: 4 frames, starting at frame 4")));
}

}  // namespace
}  // namespace kinemend
