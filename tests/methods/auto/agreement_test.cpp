// Tests of noise in short takes at low rates, where fast keyframed moves look like noise.
#include <gtest/gtest.h>

#include <vector>

#include "methods/auto/track_cleaning.hpp"
#include "motion/random_rotations.hpp"

namespace kinemend {
namespace {

constexpr double keyed_rate_hz = 30;
constexpr std::size_t keyed_tracks = 10;

// A keyed clip: five tracks snap between poses within a frame or two; five move slowly.
VectorTracks keyed_clip(std::size_t frames, double noise_deg) {
  Random random(7);
  VectorTracks tracks(frames, keyed_tracks);
  for (std::size_t n = 0; n < keyed_tracks; ++n) {
    Vec3 pose, next;
    for (std::size_t t = 0; t < frames; ++t) {
      if (t % 5 == n % 5) {
        pose = next;
        next = 20.0 * test::random_vector(random);
      }
      const double share = t % 5 == (n + 1) % 5 ? 0.5 : 1;
      const Vec3 snappy = pose + share * (next - pose);
      const Vec3 slow{0.4 * static_cast<double>(t), static_cast<double>(n), 0};
      tracks.set(t, n, (n < 5 ? snappy : slow) + noise_deg * test::random_vector(random));
    }
  }
  return tracks;
}

CleanedTracks clean_clip(VectorTracks& tracks) {
  const SampleMarks none(tracks.frames(), tracks.tracks());
  return clean_tracks(tracks, none, none, std::vector<std::vector<std::size_t>>(tracks.tracks()),
                      keyed_rate_hz, {});
}

TEST(BriefTakes, KeepTheSnapsOfKeyedClips) {
  const VectorTracks before = keyed_clip(45, 0);
  VectorTracks tracks = before;
  clean_clip(tracks);
  EXPECT_EQ(tracks.values, before.values);
}

TEST(BriefTakes, AreCleanedWhereNoiseIsOnAllTracks) {
  VectorTracks tracks = keyed_clip(45, 2);
  const CleanedTracks cleaned = clean_clip(tracks);
  for (std::size_t n = 5; n < keyed_tracks; ++n) EXPECT_GT(cleaned.shares[n], 0.9) << n;
}

TEST(BriefTakes, AreNoisyWhereMostOfAtLeastSixTracksAre) {
  const VectorTracks tracks = keyed_clip(45, 0);
  std::vector<double> noise(keyed_tracks, 2.0);
  EXPECT_EQ(noise_agreement(tracks, noise, keyed_rate_hz), 1);
  for (std::size_t n = 0; n < 4; ++n) noise[n] = 0;
  EXPECT_EQ(noise_agreement(tracks, noise, keyed_rate_hz), 0);
  VectorTracks few(45, 5);
  for (std::size_t t = 0; t < 45; ++t)
    for (std::size_t n = 0; n < 5; ++n) few.set(t, n, tracks.at(t, n));
  EXPECT_EQ(noise_agreement(few, std::vector<double>(5, 2.0), keyed_rate_hz), 0);
}

TEST(BriefTakes, AreThoseOfAFewSecondsAtLowRates) {
  EXPECT_TRUE(is_brief(45, 30));
  EXPECT_FALSE(is_brief(150, 30));
  EXPECT_FALSE(is_brief(45, 60));
  EXPECT_EQ(noise_agreement(keyed_clip(150, 0), std::vector<double>(keyed_tracks, 0.0), 30), 1);
}

}  // namespace
}  // namespace kinemend
