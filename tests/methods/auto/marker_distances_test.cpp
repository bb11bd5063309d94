// Tests of noise measured by distances between markers.
#include "methods/auto/noise_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/auto/track_cleaning.hpp"
#include "motion/random_rotations.hpp"

namespace kinemend {
namespace {

constexpr std::size_t frames = 600;

// Two segments of four markers each that swing about moving points.
VectorTracks two_segments() {
  VectorTracks tracks(frames, 8);
  for (std::size_t t = 0; t < frames; ++t) {
    const double s = static_cast<double>(t) / 30;
    for (std::size_t n = 0; n < 8; ++n) {
      const double side = n < 4 ? 1 : -1;
      const Quat turn = exp(Vec3{0.8 * std::sin(1.1 * s), side * 0.5 * std::sin(0.7 * s), 0.2});
      const auto i = static_cast<double>(n % 4);
      const Vec3 local{80 + 20 * i, 30 * (i - 1.5), 15 * std::cos(i)};
      tracks.set(t, n, Vec3{20 * s, 100 * side, 5 * std::sin(s)} + rotate(turn, local));
    }
  }
  return tracks;
}

void add_noise(VectorTracks& tracks, Vec3 deviation, double correlation, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    Vec3 noise = test::random_vector(random);
    for (std::size_t t = 0; t < tracks.frames(); ++t) {
      if (t > 0)
        noise = correlation * noise +
                std::sqrt(1 - correlation * correlation) * test::random_vector(random);
      const Vec3 off{deviation.x * noise.x, deviation.y * noise.y, deviation.z * noise.z};
      tracks.set(t, n, tracks.at(t, n) + off);
    }
  }
}

double in_distances(const VectorTracks& tracks, Vec3 deviation, double correlation) {
  return noise_in_distances(tracks, SampleMarks(tracks.frames(), tracks.tracks()),
                            std::vector<Vec3>(tracks.tracks(), deviation), correlation);
}

TEST(NoiseInDistances, IsAllOfIndependentNoise) {
  for (const double correlation : {0.0, 0.8, 0.98}) {
    for (const Vec3 deviation : {Vec3{2, 2, 2}, Vec3{1, 1, 4}}) {
      VectorTracks tracks = two_segments();
      add_noise(tracks, deviation, correlation, 7);
      const double share = in_distances(tracks, deviation, correlation);
      EXPECT_GT(share, 0.75) << correlation;
      EXPECT_LT(share, 1.05) << correlation;
    }
  }
}

TEST(NoiseInDistances, IsNothingOfMotionOrOfWhatAllMarkersShare) {
  VectorTracks tracks = two_segments();
  EXPECT_LT(in_distances(tracks, {2, 2, 2}, 0.9), 1e-9);
  Random random(3);
  for (std::size_t t = 0; t < frames; ++t) {
    const Vec3 shaken = test::random_vector(random);
    for (std::size_t n = 0; n < tracks.tracks(); ++n) tracks.set(t, n, tracks.at(t, n) + shaken);
  }
  EXPECT_LT(in_distances(tracks, {2, 2, 2}, 0.9), 1e-9);
}

TEST(NoiseInDistances, LooksAtNoMarkedSample) {
  VectorTracks tracks = two_segments();
  SampleMarks marked(frames, 8);
  Random random(4);
  for (std::size_t t = 0; t < frames; t += 3) {
    tracks.set(t, 2, tracks.at(t, 2) + 50 * test::random_vector(random));
    marked(t, 2) = 1;
  }
  EXPECT_LT(noise_in_distances(tracks, marked, std::vector<Vec3>(8, {2, 2, 2}), 0), 1e-9);
}

TEST(NoiseInDistances, IsZeroWhereNoTwoTracksAreSeenTogether) {
  VectorTracks tracks = two_segments();
  SampleMarks marked(frames, 8);
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t n = 0; n < 8; ++n) marked(t, n) = n == t / 75 ? 0 : 1;
  }
  EXPECT_EQ(noise_in_distances(tracks, marked, std::vector<Vec3>(8, {2, 2, 2}), 0), 0);
  EXPECT_EQ(in_distances(VectorTracks(1, 8), {1, 1, 1}, 0), 0);
  EXPECT_EQ(in_distances(tracks, {0, 0, 0}, 0), 0);
}

}  // namespace
}  // namespace kinemend
