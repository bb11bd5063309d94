// Tests of the methods `median` and `hampel` on spikes and steps.
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/clean.hpp"
#include "kinemend/extend/method_options.hpp"
#include "metrics/track_noise.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

TEST(Median, RemovesASpikeAndKeepsAStep) {
  Take clip = empty_take(60, 100);
  for (std::size_t f = 0; f < 60; ++f) {
    clip.rotation(f, 1) = f < 30 ? exp({0.2, 0, 0}) : exp({0, 0.9, 0});
    clip.root_position(f) = f < 30 ? Vec3{1, 2, 3} : Vec3{5, 2, 3};
  }
  const Take truth = clip;
  for (const std::size_t f : {0, 12, 45, 59}) {
    clip.rotation(f, 1) = clip.rotation(f, 1) * exp({0, 0, 1});
    clip.root_position(f) += {0, 9, 0};
  }
  clean_in_place(*make_median({.window_s = 0.05}), clip);
  EXPECT_LT(max_angle_deg(clip, truth), 1e-9);
  for (std::size_t f = 0; f < 60; ++f)
    EXPECT_LT(norm(clip.root_position(f) - truth.root_position(f)), 1e-9);
}

TEST(Hampel, ReplacesTheSpikesAndLeavesEveryOtherSampleByteForByte) {
  const Take truth = moving_take(240, 120);
  Take clip = truth;
  const std::vector<std::size_t> spikes{0, 17, 80, 81, 160, 239};
  for (const std::size_t f : spikes) {
    clip.rotation(f, 1) = clip.rotation(f, 1) * exp({0.5, -0.3, 0.2});
    clip.root_position(f) += {20, 0, 0};
  }
  const CleanResult result = clean_take(clip, *make_hampel());
  std::vector<std::size_t> changed, moved;
  for (std::size_t f = 0; f < 240; ++f) {
    if (result.take.rotation(f, 1) != clip.rotation(f, 1)) changed.push_back(f);
    if (result.take.root_position(f) != clip.root_position(f)) moved.push_back(f);
    for (const std::size_t j : {0, 2, 3, 4, 5, 6})
      ASSERT_EQ(result.take.rotation(f, j), clip.rotation(f, j));
  }
  EXPECT_EQ(changed, spikes);
  EXPECT_EQ(moved, spikes);
  EXPECT_LT(max_angle_deg(result.take, truth), 4);
  EXPECT_EQ(result.report.tracks[1].frames_repaired, spikes.size());
}

TEST(Hampel, DoesNotTakeAFastMotionForASpike) {
  Take clip = empty_take(120, 120);
  for (std::size_t f = 0; f < 120; ++f) {
    const double t = static_cast<double>(f) / 120;
    clip.rotation(f, 1) = exp({1.2 * std::sin(2 * pi * 4 * t), 0, 0});  // 1,700 degrees a second
    clip.rotation(f, 2) = exp({0, t < 0.5 ? 0 : 12 * (t - 0.5), 0});    // a start without warning
  }
  const Take output = clean_take(clip, *make_hampel()).take;
  EXPECT_EQ(output.rotations, clip.rotations);
}

TEST(Hampel, LeavesSmallDeviationsAlone) {
  Take clip = empty_take(60, 120);
  clip.rotation(30, 1) = exp({0.9 * radians_per_degree, 0, 0});
  EXPECT_EQ(clean_take(clip, *make_hampel()).take.rotation(30, 1), clip.rotation(30, 1));
  EXPECT_EQ(clean_take(clip, *make_hampel({.minimum_deg = 0.8})).take.rotation(30, 1), Quat{});
}

TEST(TrackNoise, IsTheStandardDeviationPerAxisWhateverTheMotionAndTheSpikes) {
  Random random(5);
  std::vector<Quat> track;
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < 4000; ++f) {
    const Vec3 noise{random.normal(), random.normal(), random.normal()};
    track.push_back(motion_at(1, static_cast<double>(f) / 120) * exp(0.02 * noise));
    points.push_back(Vec3{0.1 * static_cast<double>(f), 0, 0} + 0.5 * noise);
    if (random.chance(0.02)) track.back() = track.back() * exp({1, 0, 0});
  }
  EXPECT_NEAR(track_noise(track), 0.02, 0.002);
  EXPECT_NEAR(track_noise(points), 0.5, 0.03);
  EXPECT_NEAR(track_noise(points, 500), 0.5, 0.1);
  EXPECT_EQ(track_noise(std::span<const Quat>(track).first(2)), 0);
}

}  // namespace
}  // namespace kinemend::test
