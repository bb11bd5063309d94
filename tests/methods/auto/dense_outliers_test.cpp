// Tests of outliers so dense that they hide each other.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "methods/auto/spikes.hpp"
#include "motion/random_rotations.hpp"

namespace kinemend {
namespace {

constexpr double dense_rate_hz = 120;

std::vector<Vec3> swinging_track(std::size_t frames, double phase = 0) {
  std::vector<Vec3> track;
  for (std::size_t t = 0; t < frames; ++t) {
    const double s = static_cast<double>(t) / dense_rate_hz;
    track.push_back({30 * std::sin(6 * s + phase), 20 * std::cos(9 * s + phase), 5 * s});
  }
  return track;
}

// Moves a share of the samples by 25 degrees about each axis, and marks them.
std::vector<std::uint8_t> add_outliers(std::vector<Vec3>& track, double share, Random& random) {
  std::vector<std::uint8_t> marks(track.size());
  for (std::size_t t = 0; t < track.size(); ++t) {
    if (random.uniform() >= share) continue;
    const Vec3 jump = 25.0 * test::random_vector(random);
    track[t] += jump;
    marks[t] = norm(jump) > 6 ? 1 : 0;
  }
  return marks;
}

TEST(DenseOutliers, AreFoundWhereTheyAreAFifthOfTheSamples) {
  Random random(1);
  std::vector<Vec3> track = swinging_track(1200);
  const std::vector<std::uint8_t> truth = add_outliers(track, 0.2, random);
  const std::vector<std::uint8_t> found = dense_outliers(track, {}, dense_rate_hz);
  ASSERT_EQ(found.size(), track.size());
  std::size_t outliers = 0, missed = 0, invented = 0;
  for (std::size_t t = 0; t < track.size(); ++t) {
    outliers += truth[t];
    missed += truth[t] != 0 && found[t] == 0;
    invented += truth[t] == 0 && found[t] != 0;
  }
  EXPECT_GT(outliers, 150u);
  EXPECT_LE(missed, outliers / 50);
  EXPECT_LE(invented, outliers / 50);
}

TEST(DenseOutliers, AreNoneWhereOutliersAreFew) {
  Random random(2);
  std::vector<Vec3> track = swinging_track(1200);
  add_outliers(track, 0.02, random);
  EXPECT_TRUE(dense_outliers(track, {}, dense_rate_hz).empty());
}

TEST(DenseOutliers, AreNoneInADrumRollAndInSteps) {
  for (const double rate_hz : {24.0, 30.0, 60.0, 120.0}) {
    std::vector<Vec3> roll, steps;
    for (std::size_t t = 0; t < 600; ++t) {
      const double s = static_cast<double>(t) / rate_hz;
      roll.push_back({20 * std::sin(2 * pi * 9 * s), 5 * std::sin(2 * s), 0});
      steps.push_back({40 * std::sin(static_cast<double>(t / 8)), 10, 0});
    }
    EXPECT_TRUE(dense_outliers(roll, {}, rate_hz).empty()) << rate_hz;
    EXPECT_TRUE(dense_outliers(steps, {}, rate_hz).empty()) << rate_hz;
  }
}

TEST(DenseOutliers, LeaveMissingSamplesOut) {
  Random random(3);
  std::vector<Vec3> track = swinging_track(600);
  add_outliers(track, 0.2, random);
  std::vector<std::uint8_t> missing(track.size());
  for (std::size_t t = 200; t < 240; ++t) {
    missing[t] = 1;
    track[t] = {1000, 1000, 1000};
  }
  const std::vector<std::uint8_t> found = dense_outliers(track, missing, dense_rate_hz);
  ASSERT_EQ(found.size(), track.size());
  for (std::size_t t = 200; t < 240; ++t) EXPECT_EQ(found[t], 0);
}

// Root mean square distance from the truth after spike repair.
double error_left(double share, std::size_t damaged_tracks, std::uint64_t seed) {
  constexpr std::size_t frames = 600, count = 8;
  Random random(seed);
  VectorTracks tracks(frames, count);
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<Vec3> track = swinging_track(frames, static_cast<double>(n));
    if (n < damaged_tracks) add_outliers(track, share, random);
    for (std::size_t t = 0; t < frames; ++t) tracks.set(t, n, track[t]);
  }
  find_spikes(tracks, SampleMarks(frames, count), std::vector<std::vector<std::size_t>>(count),
              dense_rate_hz);
  double sum = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const std::vector<Vec3> truth = swinging_track(frames, static_cast<double>(n));
    for (std::size_t t = 0; t < frames; ++t) {
      const Vec3 off = tracks.at(t, n) - truth[t];
      sum += dot(off, off);
    }
  }
  return std::sqrt(sum / static_cast<double>(frames * count));
}

TEST(FindSpikes, RepairsDenseOutliersOfAllTracks) {
  for (const double share : {0.05, 0.1, 0.2}) EXPECT_LT(error_left(share, 8, 4), 0.8) << share;
}

// A swing there and back within a fifth of a second, among dense outliers.
TEST(FindSpikes, KeepsAQuickMoveAmongDenseOutliers) {
  constexpr std::size_t frames = 800, count = 8;
  Random random(6);
  VectorTracks tracks(frames, count), truth(frames, count);
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<Vec3> track(frames);
    for (std::size_t t = 465; t <= 495; ++t)
      track[t].x = 300 * (1 - std::cos(2 * pi * static_cast<double>(t - 465) / 30));
    for (std::size_t t = 0; t < frames; ++t) truth.set(t, n, track[t]);
    add_outliers(track, 0.2, random);
    for (std::size_t t = 0; t < frames; ++t) tracks.set(t, n, track[t]);
  }
  find_spikes(tracks, SampleMarks(frames, count), std::vector<std::vector<std::size_t>>(count),
              dense_rate_hz);
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t t = 465; t <= 495; ++t)
      EXPECT_LT(norm(tracks.at(t, n) - truth.at(t, n)), 200) << n << ' ' << t;
}

TEST(FindSpikes, RepairsDenseOutliersOfOneTrackOfACleanTake) {
  EXPECT_LT(error_left(0.2, 1, 5), 0.8);
}

}  // namespace
}  // namespace kinemend
