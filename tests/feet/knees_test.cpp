// Holding feet does not make knees pop: the largest second difference of their angles is hardly
// above that of the take.
#include <gtest/gtest.h>

#include <algorithm>

#include "feet/support.hpp"

namespace kinemend {
namespace {

using test::forced;
using test::synthetic_clip;
using test::with_drift;
using test::with_smooth_noise;

double allowed_pop_deg(const FeetReport& report) {
  return std::max(1.1 * report.before.knee_pop_deg, report.before.knee_pop_deg + 0.5);
}

TEST(Knees, DoNotPopInWalksThatDriftAndJitter) {
  for (const double rate : {30.0, 60.0, 120.0}) {
    for (const double noise_deg : {0.0, 0.3, 0.6}) {
      for (const std::uint64_t seed : {1u, 2u, 3u}) {
        Take clip = with_smooth_noise(with_drift(synthetic_clip("walk", 8, rate, seed), 4),
                                      noise_deg, seed);
        const FeetReport report = clean_feet(clip, forced());
        EXPECT_LE(report.after.knee_pop_deg, allowed_pop_deg(report))
            << rate << " Hz, noise " << noise_deg << ", seed " << seed;
        EXPECT_LT(report.after.most_slide, 0.1) << rate << " Hz, seed " << seed;  // cm
      }
    }
  }
}

// A standing body whose hips or one foot jump for two frames, too long for a spike filter.
Take with_jump(const char* joint, double deg, double rise) {
  Take clip = synthetic_clip("still", 3);
  for (const std::size_t f : {180u, 181u}) {
    clip.root_position(f).y += rise;
    Quat& own = clip.rotation(f, test::joint_of(clip, joint));
    own = own * exp({deg * radians_per_degree, 0, 0});
  }
  return clip;
}

TEST(Knees, AreSparedWhatTheHipsJump) {
  Take clip = with_jump("Hips", 0, 0.5);
  const Take before = clip;
  const FeetReport report = clean_feet(clip, forced());
  ASSERT_FALSE(report.contacts.empty());
  EXPECT_LT(report.after.knee_pop_deg, allowed_pop_deg(report));
  EXPECT_LT(report.after.most_slide, 0.02);
  // The root correction removes the jump.
  const double jump = before.root_position(180).y - before.root_position(176).y;
  const double left = clip.root_position(180).y - clip.root_position(176).y;
  EXPECT_LT(std::fabs(left), 0.3 * jump);
}

TEST(Knees, AreSparedWhatAFootTurnsThatStandsOnItsToe) {
  Take clip = with_jump("LeftFoot", 6, 0);
  FeetSettings settings;
  settings.contacts = {{{0, FootPart::toe, 100, 260}}};
  const FeetReport report = clean_feet(clip, settings);
  EXPECT_LT(report.after.knee_pop_deg, allowed_pop_deg(report));
  EXPECT_LT(report.after.most_slide, 0.02);
}

TEST(Knees, AreSparedWithoutARootThatMoves) {
  Take clip = with_smooth_noise(with_drift(synthetic_clip("walk", 8), 2), 0.3, 4);
  clip.skeleton.channels[0] = make_channels(false, parse_rotation_order("ZXY"));
  const Take before = clip;
  const FeetReport report = clean_feet(clip, forced());
  EXPECT_EQ(clip.positions, before.positions);
  EXPECT_LE(report.after.knee_pop_deg, allowed_pop_deg(report));
}

}  // namespace
}  // namespace kinemend
