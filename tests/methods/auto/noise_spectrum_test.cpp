// Tests of the estimated colour and strength of noise, and of `auto` under such noise.
#include "methods/auto/noise_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/auto/track_cleaning.hpp"
#include "motion/random_rotations.hpp"

namespace kinemend {
namespace {

constexpr double rate_hz = 120;
constexpr std::size_t tracks_count = 8;

Vec3 curve(std::size_t frame, std::size_t track) {
  const double s = static_cast<double>(frame) / rate_hz, phase = static_cast<double>(track);
  return {30 * std::sin(6 * s + phase), 10 * std::cos(9 * s + phase), 5 * std::sin(2 * s)};
}

// Curves with noise of this deviation (`deep` times as much in z) and correlation.
VectorTracks correlated_curves(std::size_t frames, double deviation, double correlation,
                               std::uint64_t seed, double deep = 1) {
  Random random(seed);
  VectorTracks tracks(frames, tracks_count);
  for (std::size_t n = 0; n < tracks_count; ++n) {
    Vec3 noise = test::random_vector(random);
    for (std::size_t t = 0; t < frames; ++t) {
      if (t > 0)
        noise = correlation * noise +
                std::sqrt(1 - correlation * correlation) * test::random_vector(random);
      tracks.set(t, n, curve(t, n) + deviation * Vec3{noise.x, noise.y, deep * noise.z});
    }
  }
  return tracks;
}

NoiseSpectrum spectrum_of(const VectorTracks& tracks, TrackKind kind = TrackKind::rotations) {
  return noise_spectrum_of(tracks, SampleMarks(tracks.frames(), tracks.tracks()), rate_hz, kind);
}

double error_of(const VectorTracks& tracks) {
  double sum = 0;
  for (std::size_t t = 0; t < tracks.frames(); ++t) {
    for (std::size_t n = 0; n < tracks.tracks(); ++n) {
      const Vec3 off = tracks.at(t, n) - curve(t, n);
      sum += dot(off, off);
    }
  }
  return std::sqrt(sum / static_cast<double>(3 * tracks.frames() * tracks.tracks()));
}

CleanedTracks clean(VectorTracks& tracks, TrackKind kind = TrackKind::rotations) {
  const SampleMarks none(tracks.frames(), tracks.tracks());
  return clean_tracks(tracks, none, none, std::vector<std::vector<std::size_t>>(tracks.tracks()),
                      rate_hz, {.kind = kind});
}

TEST(NoiseSpectrum, HasTheColourAndTheStrengthOfTheNoise) {
  for (const double correlation : {0.5, 0.8}) {
    const NoiseSpectrum found = spectrum_of(correlated_curves(720, 1.5, correlation, 1));
    EXPECT_TRUE(found.is_clear);
    EXPECT_NEAR(found.correlation, correlation, 0.21);
    for (const double strength : found.strengths())
      EXPECT_NEAR(strength * found.fast_share(),
                  1.5 * std::sqrt((1 - correlation) / (1 + correlation)), 0.1);
  }
}

TEST(NoiseSpectrum, SeesTheAxesApart) {
  const NoiseSpectrum found = spectrum_of(correlated_curves(1200, 1.5, 0.8, 2, 3));
  ASSERT_EQ(found.deviations.size(), tracks_count);
  for (const Vec3 deviations : found.deviations) {
    EXPECT_NEAR(deviations.z / deviations.x, 3, 0.7);
    EXPECT_NEAR(deviations.y / deviations.x, 1, 0.3);
  }
}

TEST(NoiseSpectrum, IsWhiteWhereTheNoiseIsWhite) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const double deviation : {0.3, 1.5, 5.0}) {
      const NoiseSpectrum found = spectrum_of(correlated_curves(400, deviation, 0, seed));
      EXPECT_EQ(found.correlation, 0);
      EXPECT_FALSE(found.is_clear);
    }
  }
}

// Some tracks have white noise, others only rough motion.
TEST(NoiseSpectrum, IsWhiteWhereTracksDoNotAgree) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    VectorTracks tracks = correlated_curves(720, 1.5, 0, seed);
    const VectorTracks rough = correlated_curves(720, 4, 0.98, seed + 10);
    for (std::size_t t = 0; t < tracks.frames(); ++t) {
      for (std::size_t n = 4; n < tracks_count; ++n) tracks.set(t, n, rough.at(t, n));
    }
    EXPECT_EQ(spectrum_of(tracks).correlation, 0);
  }
}

TEST(NoiseSpectrum, LeavesShortTakesAndFewTracksAlone) {
  EXPECT_FALSE(spectrum_of(correlated_curves(20, 1.5, 0.8, 1)).is_clear);
  VectorTracks few(400, 2);
  const VectorTracks tracks = correlated_curves(400, 1.5, 0.8, 1);
  for (std::size_t t = 0; t < 400; ++t) {
    for (std::size_t n = 0; n < 2; ++n) few.set(t, n, tracks.at(t, n));
  }
  EXPECT_FALSE(spectrum_of(few).is_clear);
}

TEST(CleanTracks, TakeColouredNoiseForWhatItIs) {
  for (const auto& [correlation, most] : {std::pair{0.5, 0.5}, std::pair{0.8, 0.65}}) {
    VectorTracks tracks = correlated_curves(720, 1.5, correlation, 3);
    const CleanedTracks verdicts = clean(tracks);
    EXPECT_TRUE(verdicts.spectrum.is_clear);
    EXPECT_LT(error_of(tracks), 1.5 * most) << correlation;
  }
}

TEST(CleanTracks, BridgeSpikesInColouredNoise) {
  VectorTracks tracks = correlated_curves(720, 1.5, 0.8, 4);
  for (std::size_t t = 30; t < 720; t += 90)
    tracks.set(t, t % tracks_count, tracks.at(t, t % tracks_count) + Vec3{60, -60, 60});
  const CleanedTracks verdicts = clean(tracks);
  for (std::size_t t = 30; t < 720; t += 90) EXPECT_EQ(verdicts.marked(t, t % tracks_count), 1);
  EXPECT_LT(error_of(tracks), 1.1);
}

// Slow or fast motion of bodies without noise, in takes as clean as a good capture.
TEST(CleanTracks, KeepSlowMotionOfCleanTakes) {
  for (const TrackKind kind : {TrackKind::rotations, TrackKind::positions}) {
    for (const double measured : {0.0, 0.02, 0.04}) {
      Random random(5);
      VectorTracks tracks(1200, tracks_count);
      std::vector<Vec3> sway(tracks_count);
      for (std::size_t t = 0; t < 1200; ++t) {
        const double s = static_cast<double>(t) / rate_hz;
        for (std::size_t n = 0; n < tracks_count; ++n) {
          const double phase = static_cast<double>(n);
          sway[n] = 0.995 * sway[n] + 0.002 * test::random_vector(random);
          const Vec3 breath{2 * std::sin(1.6 * s + phase), 0, 0};
          const Vec3 tremor{0, 1.5 * std::sin(2 * pi * 5 * s + phase), 0};
          const Vec3 roll{0, 0, 8 * std::sin(2 * pi * 7 * s + phase) * (n % 2 ? 1.0 : 0.0)};
          tracks.set(t, n,
                     breath + tremor + roll + sway[n] + measured * test::random_vector(random));
        }
      }
      const VectorTracks before = tracks;
      clean(tracks, kind);
      EXPECT_TRUE(std::equal(tracks.values.begin(), tracks.values.end(), before.values.begin(),
                             [](Vec3 a, Vec3 b) { return norm(a - b) < 1e-9; }))
          << measured;
    }
  }
}

}  // namespace
}  // namespace kinemend
