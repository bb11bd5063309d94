// Tests of takes whose samples are held or interpolated from a lower rate.
#include "methods/auto/held_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/extend/random.hpp"
#include "methods/auto/track_cleaning.hpp"

namespace kinemend {
namespace {

Vec3 curve(double seconds, std::size_t track) {
  const double phase = static_cast<double>(track);
  return {30 * std::sin(6 * seconds + phase), 10 * std::cos(9 * seconds + phase), 5 * seconds};
}

VectorTracks noisy_curves(std::size_t frames, double rate_hz, double deviation,
                          std::uint64_t seed) {
  Random random(seed);
  VectorTracks tracks(frames, 4);
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t n = 0; n < tracks.tracks(); ++n) {
      const double x = random.normal(), y = random.normal(), z = random.normal();
      tracks.set(t, n, curve(static_cast<double>(t) / rate_hz, n) + deviation * Vec3{x, y, z});
    }
  }
  return tracks;
}

// Expands samples to `frames` frames by a pattern.
VectorTracks joined(const VectorTracks& samples, const SamplePattern& pattern, std::size_t frames) {
  VectorTracks tracks(frames, samples.tracks());
  for (std::size_t t = 0; t < frames; ++t) {
    // The last measurement at or before the frame; index 0 lies before the take.
    const double place = (static_cast<double>(t) + pattern.step - pattern.first) / pattern.step;
    const auto i = static_cast<std::size_t>(place + 1e-9);
    const double share =
        pattern.join == SampleJoin::held ? 0 : std::max(0.0, place - static_cast<double>(i));
    for (std::size_t n = 0; n < samples.tracks(); ++n) {
      const Vec3 from = samples.at(i, n);
      tracks.set(t, n, share > 0 ? from + share * (samples.at(i + 1, n) - from) : from);
    }
  }
  return tracks;
}

TEST(SamplePattern, IsFoundAtEachStepAndPhase) {
  for (const SampleJoin join : {SampleJoin::held, SampleJoin::linear}) {
    for (double step = 2; step <= 8; ++step) {
      for (double first = 0; first < step; ++first) {
        for (const double deviation : {0.0, 1.5}) {
          const auto seed = static_cast<std::uint64_t>(step);
          const VectorTracks tracks =
              joined(noisy_curves(110, 20, deviation, seed), {join, step, first}, 200);
          const SamplePattern found = find_sample_pattern(tracks, SampleMarks(200, 4));
          EXPECT_EQ(found.join, join);
          EXPECT_EQ(found.step, step);
          EXPECT_EQ(found.first, first);
        }
      }
    }
  }
}

// 24 Hz at 60 Hz, 50 at 120, 25 at 120, 100 at 120, and 48 at 60.
TEST(SamplePattern, IsFoundWhereSamplesAreHeldForABrokenNumberOfFrames) {
  for (const double step : {2.5, 2.4, 4.8, 1.2, 1.25}) {
    for (const double first : {0.0, 0.3, 0.95}) {
      const SamplePattern made{SampleJoin::held, step, first};
      const VectorTracks tracks = joined(noisy_curves(420, 50, 1.5, 4), made, 480);
      const SamplePattern found = find_sample_pattern(tracks, SampleMarks(480, 4));
      ASSERT_EQ(found.join, SampleJoin::held) << step << " " << first;
      EXPECT_NEAR(found.step, step, 0.01);
      EXPECT_NEAR(std::remainder(found.first - first, step), 0, 0.5);
      for (std::size_t i = 0; i < found.samples(480); ++i) {
        const std::size_t frame = found.frame(i);
        ASSERT_LT(frame, 480U);
        if (i == 0) continue;
        EXPECT_NE(tracks.at(frame, 1), tracks.at(frame - 1, 1)) << frame;
        EXPECT_GT(frame, found.frame(i - 1));
      }
    }
  }
}

TEST(SamplePattern, IsNoneWhereFramesRepeatWithoutAClock) {
  const VectorTracks samples = noisy_curves(480, 60, 1.5, 4);
  VectorTracks tracks(480, 4);
  Random random(8);
  for (std::size_t t = 0, i = 0; t < 480; ++t) {
    i += t > 0 && random.uniform() < 0.6 ? 1 : 0;
    for (std::size_t n = 0; n < 4; ++n) tracks.set(t, n, samples.at(i, n));
  }
  EXPECT_EQ(find_sample_pattern(tracks, SampleMarks(480, 4)).join, SampleJoin::none);
}

TEST(SamplePattern, IsNoneWhereEveryFrameIsMeasured) {
  for (const double deviation : {0.0, 0.02, 1.5}) {
    for (const std::size_t frames : {4, 20, 40, 100, 400}) {
      const VectorTracks tracks = noisy_curves(frames, 120, deviation, frames);
      EXPECT_EQ(find_sample_pattern(tracks, SampleMarks(frames, 4)).join, SampleJoin::none);
    }
  }
}

TEST(SamplePattern, IsNoneWhereTracksStandStillOrDisagree) {
  EXPECT_EQ(find_sample_pattern(VectorTracks(200, 3), SampleMarks(200, 3)).join, SampleJoin::none);
  VectorTracks tracks = joined(noisy_curves(110, 20, 1, 1), {SampleJoin::held, 2, 0}, 200);
  const VectorTracks other = noisy_curves(200, 120, 1, 2);
  for (std::size_t t = 0; t < 200; ++t) tracks.set(t, 1, other.at(t, 1));
  EXPECT_EQ(find_sample_pattern(tracks, SampleMarks(200, 4)).join, SampleJoin::none);
}

TEST(SpreadSamples, GoesThroughEachMeasurementAndFollowsASmoothCurveBetweenThem) {
  constexpr double rate_hz = 30;
  const SamplePattern pattern{SampleJoin::linear, 4, 1};
  const VectorTracks samples = noisy_curves(100, rate_hz, 0, 1);
  VectorTracks tracks(395, 4);
  spread_samples(samples, SampleMarks(100, 4), {1, 1, 1, 1}, pattern, tracks);
  for (std::size_t i = 0; i < 98; ++i)
    EXPECT_LT(norm(tracks.at(pattern.frame(i), 2) - samples.at(i, 2)), 1e-12);
  for (std::size_t t = 30; t < 360; ++t) {
    const double seconds = (static_cast<double>(t) - 1) / (4 * rate_hz);
    EXPECT_LT(norm(tracks.at(t, 2) - curve(seconds, 2)), 0.01);
  }
}

TEST(SpreadSamples, ChangesOnlyWhatFollowsFromMarkedSamplesOfAQuietTrack) {
  const SamplePattern pattern{SampleJoin::linear, 3, 0};
  VectorTracks samples = noisy_curves(41, 40, 0, 1);
  VectorTracks tracks = joined(noisy_curves(42, 40, 0, 1), {SampleJoin::linear, 3, 0}, 120);
  const VectorTracks before = tracks;
  SampleMarks marked(40, 4);
  marked(10, 1) = 1;
  samples = measured_samples(tracks, pattern);
  samples.set(10, 1, {0, 0, 0});
  const SampleMarks spread = spread_samples(samples, marked, {0, 0, 0, 0}, pattern, tracks);
  for (std::size_t t = 0; t < 120; ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const bool touched = n == 1 && t > 27 && t < 33;
      EXPECT_EQ(spread(t, n) != 0, touched) << t;
      EXPECT_EQ(tracks.at(t, n) == before.at(t, n), !touched) << t;
    }
  }
  EXPECT_LT(norm(tracks.at(30, 1)), 1e-12);
}

TEST(CleanTracks, TakeSamplesOfALowerRateForWhatTheyAre) {
  const std::vector<std::vector<std::size_t>> nearby(4);
  for (const SamplePattern pattern :
       {SamplePattern{SampleJoin::held, 2, 0}, SamplePattern{SampleJoin::linear, 4, 0},
        SamplePattern{SampleJoin::held, 2.4, 0}}) {
    const double low_rate_hz = 120 / pattern.step;
    VectorTracks low = noisy_curves(300, low_rate_hz, 1.5, 3);
    // The sample before the take is unused.
    VectorTracks shifted(301, 4);
    for (std::size_t i = 0; i < 300; ++i) {
      for (std::size_t n = 0; n < 4; ++n) shifted.set(i + 1, n, low.at(i, n));
    }
    const auto frames = static_cast<std::size_t>(290 * pattern.step) + 1;
    VectorTracks tracks = joined(shifted, pattern, frames);
    const SampleMarks none(frames, 4);
    const CleanedTracks verdicts = clean_tracks(tracks, none, none, nearby, 120, {});
    EXPECT_NEAR(verdicts.pattern.step, pattern.step, 0.005);
    double error = 0;
    for (std::size_t t = 0; t < frames; ++t) {
      for (std::size_t n = 0; n < 4; ++n) {
        const Vec3 off = tracks.at(t, n) - curve(static_cast<double>(t) / 120, n);
        error += dot(off, off) / static_cast<double>(12 * frames);
      }
    }
    for (const double level : verdicts.noise) EXPECT_NEAR(level, 1.5, 0.3);
    EXPECT_LT(std::sqrt(error), 0.8);
  }
}

}  // namespace
}  // namespace kinemend
