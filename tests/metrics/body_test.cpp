// Tests of foot slide, and of the joints that count as feet.
#include <gtest/gtest.h>

#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/metrics.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::resting_clip;

// A stick of 170 units with one toe joint at the floor; the root carries all of it.
Skeleton one_legged() {
  Skeleton skeleton;
  skeleton.add_joint("hips", -1, {0, 85, 0}, make_channels(true, parse_rotation_order("ZXY")));
  skeleton.add_joint("RightToeBase", 0, {0, -85, 0},
                     make_channels(false, parse_rotation_order("ZXY")));
  skeleton.end_sites.push_back({0, {0, 85, 0}, "top"});
  return skeleton;
}

TEST(FootSlide, IsTheHorizontalTravelPerFrameInContact) {
  const Take reference = resting_clip(one_legged(), 5, 100);
  Take other = reference;
  // Steps of the toe: (3, up, 4), 0, (0, 7, 0), 0 -> horizontal 5, 0, 0, 0.
  for (std::size_t f = 1; f < 5; ++f) other.root_position(f) += Vec3{3, 2, 4};
  for (std::size_t f = 3; f < 5; ++f) other.root_position(f) += Vec3{0, 7, 0};
  const FootSlide slide = foot_slide(reference, other);
  EXPECT_EQ(slide.contact_steps, 4u);
  EXPECT_NEAR(slide.per_frame, 5.0 / 4, 1e-12);
  EXPECT_EQ(foot_slide(reference, reference).per_frame, 0.0);
}

TEST(FootSlide, CountsOnlyWhileTheReferenceIsLowAndSlow) {
  Take reference = resting_clip(one_legged(), 6, 100);
  // 0.03 of the height is 5.1 units; 0.25 heights per second at 100 Hz is 0.425 a frame.
  reference.root_position(3).y += 6;    // high: excludes steps 2-3 and 3-4
  reference.root_position(5).x += 0.5;  // fast: excludes step 4-5
  Take other = reference;
  for (std::size_t f = 1; f < 6; ++f) other.root_position(f).x += static_cast<double>(f);
  const FootSlide slide = foot_slide(reference, other);
  EXPECT_EQ(slide.contact_steps, 2u);
  EXPECT_NEAR(slide.per_frame, 1.0, 1e-12);
  reference.root_position(5).x -= 0.1;  // a step of 0.4 is slow enough
  EXPECT_EQ(foot_slide(reference, other).contact_steps, 3u);
}

TEST(FootSlide, TakesTheAxisThatPointsUp) {
  const Take reference = resting_clip(one_legged(), 2, 100);
  Take other = reference;
  other.root_position(1) += Vec3{3, 4, 12};
  FootSlideSettings settings;
  settings.up = Axis::z;
  EXPECT_NEAR(foot_slide(reference, other, settings).per_frame, 5.0, 1e-12);
  settings.up = Axis::x;
  EXPECT_NEAR(foot_slide(reference, other, settings).per_frame, std::hypot(4.0, 12.0), 1e-12);
}

TEST(FootSlide, TakesJointsByNumber) {
  const Take reference = resting_clip(one_legged(), 2, 100);
  FootSlideSettings settings;
  settings.joints = {0, 1};
  EXPECT_EQ(foot_slide(reference, reference, settings).contact_steps, 2u);
  settings.joints = {2};
  EXPECT_THROW(foot_slide(reference, reference, settings), Error);
}

TEST(FootJoints, AreFoundByPartsOfTheirNames) {
  Skeleton skeleton;
  for (const char* name :
       {"Hips", "mixamorig:LeftFoot", "LEFT_TOE_BASE", "r_ankle", "Head", "RightHand"}) {
    skeleton.add_joint(name, skeleton.joint_count() == 0 ? -1 : 0, {}, {});
  }
  EXPECT_EQ(foot_joints(skeleton), (std::vector<std::size_t>{1, 2, 3}));
}

}  // namespace
}  // namespace kinemend
