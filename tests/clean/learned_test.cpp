// What the method `learned` does with takes, whatever its network says. This one asks for the
// Gaussian of 50 ms everywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "clean/takes.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/corrupt.hpp"
#include "kinemend/experimental/synth.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"
#include "priors/motion_support.hpp"

namespace kinemend::test {
namespace {

constexpr std::size_t gaussian_of_50_ms = 5;

Clip walk_for_networks(double rate_hz) {
  return synthesize({.motion = "walk", .duration_s = 3, .frame_rate_hz = rate_hz});
}

Clip with_damage(Clip clip, const std::string& damage, const OptionValues& options) {
  Random random(5);
  apply_damage(clip, damage, options, random);
  return clip;
}

// Asks for one smoother, whatever it sees.
std::unique_ptr<Cleaner> asking_for(std::size_t smoother) {
  return make_learned({}, std::make_shared<const Model>(one_smoother_model(smoother)));
}

Clip without_known_names(Clip clip) {
  for (std::size_t j = 0; j < clip.skeleton.joint_count(); ++j)
    clip.skeleton.names[j] = "Q" + std::to_string(j);
  return clip;
}

TEST(LearnedCleaner, SmoothsByTimeAndNotByFrames) {
  for (const double rate_hz : {60.0, 120.0, 240.0}) {
    const Clip truth = walk_for_networks(rate_hz);
    const Clip noisy = with_damage(truth, "gaussian", {{"std_deg", 3.0}});
    const Clip cleaned = clean_clip(noisy, *asking_for(gaussian_of_50_ms)).clip;
    EXPECT_LT(rms_deg(truth, cleaned), 0.75 * rms_deg(truth, noisy)) << rate_hz << " Hz";
  }
}

TEST(LearnedCleaner, MakesTheSameOfJointsWhoseNamesItDoesNotKnow) {
  const Clip noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 1.0}});
  const std::unique_ptr<Cleaner> smoothing = asking_for(gaussian_of_50_ms);
  const Clip known = clean_clip(noisy, *smoothing).clip;
  Clip unknown = clean_clip(without_known_names(noisy), *smoothing).clip;
  unknown.skeleton.names = known.skeleton.names;
  // Vectors about another reference are the same but for the curvature of rotations.
  EXPECT_LT(rms_deg(known, unknown), 0.1);
}

TEST(LearnedCleaner, SmoothsMarkers) {
  const MarkerClip truth = joint_markers(walk_for_networks(120));
  MarkerClip noisy = truth;
  Random random(5);
  apply_damage(noisy, "gaussian", {{"std_deg", 4.0}}, random);
  const MarkerClip cleaned = clean_markers(noisy, *asking_for(gaussian_of_50_ms)).clip;
  double before = 0, after = 0;
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    const Vec3 damage = noisy.positions[i] - truth.positions[i];
    const Vec3 left = cleaned.positions[i] - truth.positions[i];
    before += dot(damage, damage);
    after += dot(left, left);
  }
  EXPECT_LT(std::sqrt(after), 0.8 * std::sqrt(before));
}

TEST(LearnedCleaner, RepairsSpikesBeforeTheNetworkSeesThem) {
  const Clip truth = walk_for_networks(120);
  const Clip spiky = with_damage(truth, "outliers", {{"share", 0.005}, {"std_deg", 25.0}});
  EXPECT_LT(rms_deg(truth, clean_clip(spiky, *asking_for(0)).clip), 0.4 * rms_deg(truth, spiky));
}

TEST(LearnedCleaner, KeepsATakeOfWhichItsNetworkKeepsAll) {
  const Clip noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 1.0}});
  for (const Clip& take : {noisy, without_known_names(noisy)})
    EXPECT_LT(rms_deg(take, clean_clip(take, *asking_for(0)).clip), 1e-3);
}

TEST(LearnedCleaner, GivesTheSameAgain) {
  const Clip noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 3.0}});
  EXPECT_EQ(clean_clip(noisy, *asking_for(gaussian_of_50_ms)).clip.local_rotations,
            clean_clip(noisy, *asking_for(gaussian_of_50_ms)).clip.local_rotations);
}

TEST(LearnedCleaner, LeavesTheShortestTakesAsTheyAre) {
  const Clip noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 3.0}});
  for (const std::size_t frames : {1, 2, 3}) {
    const Clip take = slice(noisy, 0, frames);
    EXPECT_EQ(clean_clip(take, *asking_for(gaussian_of_50_ms)).clip.local_rotations,
              take.local_rotations);
  }
}

TEST(LearnedCleaner, SaysThatItNeedsAModel) {
  try {
    make_learned();
    FAIL() << "was made";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("made by kinemend-train learned"));
  }
}

}  // namespace
}  // namespace kinemend::test
