// Tests of the single steps of the method `auto`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "kinemend/lab/synth.hpp"
#include "methods/auto/smoothing.hpp"
#include "methods/auto/spikes.hpp"
#include "methods/auto/track_vectors.hpp"
#include "methods/auto/vector_tracks.hpp"
#include "motion/random_rotations.hpp"

namespace kinemend {
namespace {

constexpr double chart_rate_hz = 120;

// A joint that turns more than once about an axis that itself moves.
std::vector<Quat> turning_track(std::size_t frames) {
  std::vector<Quat> track;
  for (std::size_t t = 0; t < frames; ++t) {
    const double s = static_cast<double>(t) / chart_rate_hz;
    track.push_back(exp({0, 3.0 * s, 0}) * exp({1.4 * std::sin(2 * s), 0, 0.5 * std::cos(3 * s)}));
  }
  return track;
}

TEST(SmoothChart, GivesBackEveryRotation) {
  const std::vector<Quat> track = turning_track(400);
  const RotationChart chart = smooth_chart(track, chart_rate_hz);
  for (std::size_t t = 0; t < track.size(); ++t) {
    EXPECT_LT(angle_between(track[t], chart.rotation_of(t, chart.vector_of(t, track[t]))), 1e-12);
  }
}

TEST(SmoothChart, IsContinuousThroughWholeTurns) {
  const std::vector<Quat> track = turning_track(600);
  const RotationChart chart = smooth_chart(track, chart_rate_hz);
  for (std::size_t t = 1; t < track.size(); ++t) {
    const double step = norm(chart.vector_of(t, track[t]) - chart.vector_of(t - 1, track[t - 1]));
    EXPECT_NEAR(step, angle_between(track[t - 1], track[t]), 2e-3);
  }
}

TEST(SmoothChart, KeepsTheSizeOfNoise) {
  Random random(1);
  const std::vector<Quat> track = turning_track(500);
  const RotationChart chart = smooth_chart(track, chart_rate_hz);
  for (std::size_t t = 0; t < track.size(); ++t) {
    const Vec3 noise = 0.02 * test::random_vector(random);
    const Vec3 moved = chart.vector_of(t, track[t] * exp(noise)) - chart.vector_of(t, track[t]);
    EXPECT_NEAR(norm(moved), norm(noise), 0.03 * norm(noise) + 1e-12);
  }
}

TEST(SmoothChart, TakesNoNoticeOfSigns) {
  std::vector<Quat> track = turning_track(50);
  const RotationChart chart = smooth_chart(track, chart_rate_hz);
  for (std::size_t t = 1; t < track.size(); t += 2) track[t] = -track[t];
  const RotationChart other = smooth_chart(track, chart_rate_hz);
  for (std::size_t t = 0; t < track.size(); ++t) {
    EXPECT_LT(norm(chart.vector_of(t, track[t]) - other.vector_of(t, -track[t])), 1e-12);
  }
}

// N tracks of smooth curves with white noise of the given deviations, degrees.
VectorTracks noisy_curves(std::size_t frames, const std::vector<double>& deviations,
                          Random& random) {
  VectorTracks tracks(frames, deviations.size());
  for (std::size_t t = 0; t < frames; ++t) {
    const double s = static_cast<double>(t) / chart_rate_hz;
    for (std::size_t n = 0; n < deviations.size(); ++n) {
      const double phase = static_cast<double>(n);
      const Vec3 curve{30 * std::sin(6 * s + phase), 10 * std::cos(9 * s + phase), 5 * s};
      tracks.set(t, n, curve + deviations[n] * test::random_vector(random));
    }
  }
  return tracks;
}

TEST(NoiseLevels, AreThoseOfTheNoise) {
  Random random(2);
  const std::vector<double> deviations{0, 0.2, 1.5, 4};
  const VectorTracks tracks = noisy_curves(1000, deviations, random);
  const std::vector<double> levels = noise_levels(tracks, SampleMarks(1000, 4));
  EXPECT_LT(levels[0], 0.01);
  for (std::size_t n = 1; n < 4; ++n) EXPECT_NEAR(levels[n], deviations[n], 0.06 * deviations[n]);
}

TEST(NoiseLevels, LeaveMarkedSamplesOut) {
  Random random(3);
  VectorTracks tracks = noisy_curves(600, {1.0}, random);
  SampleMarks marked(600, 1);
  for (std::size_t t = 5; t < 600; t += 9) {
    marked(t, 0) = 1;
    tracks.set(t, 0, {500, -500, 500});
  }
  EXPECT_NEAR(noise_levels(tracks, marked)[0], 1.0, 0.1);
}

TEST(SmoothingShares, GrowFromZeroToOne) {
  const std::vector<double> shares = smoothing_shares({0.01, 0.2, 0.3, 0.5, 1.5, 3}, chart_rate_hz);
  EXPECT_EQ(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
  for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_GE(shares[i], shares[i - 1]);
}

TEST(FillMarked, DrawsStraightLinesAndHoldsTheEnds) {
  VectorTracks tracks(6, 1);
  for (std::size_t t = 0; t < 6; ++t) tracks.set(t, 0, {static_cast<double>(t * t), 0, 0});
  SampleMarks marked(6, 1);
  marked(0, 0) = marked(2, 0) = marked(3, 0) = marked(5, 0) = 1;
  fill_marked(tracks.track(0), marked.track(0));
  EXPECT_DOUBLE_EQ(tracks.at(0, 0).x, 1);
  EXPECT_DOUBLE_EQ(tracks.at(2, 0).x, 1 + 15.0 / 3);
  EXPECT_DOUBLE_EQ(tracks.at(3, 0).x, 1 + 30.0 / 3);
  EXPECT_DOUBLE_EQ(tracks.at(5, 0).x, 16);
}

TEST(FindSpikes, FindsAlmostAllAndHardlyAnythingElse) {
  Random random(4);
  const std::size_t frames = 1000, count = 10;
  VectorTracks tracks = noisy_curves(frames, std::vector<double>(count, 1.5), random);
  SampleMarks truth(frames, count);
  for (std::size_t i = 0; i < 60; ++i) {
    const std::size_t t = random.below(frames), n = random.below(count);
    if (truth(t, n) != 0) continue;
    truth(t, n) = 1;
    tracks.set(t, n, tracks.at(t, n) + 25.0 * test::random_vector(random));
  }
  const DetectedSpikes detected =
      find_spikes(tracks, SampleMarks(frames, count), std::vector<std::vector<std::size_t>>(count),
                  chart_rate_hz);
  std::size_t found = 0, spikes = 0, wrong = 0;
  for (std::size_t i = 0; i < truth.marks.size(); ++i) {
    spikes += truth.marks[i];
    found += truth.marks[i] != 0 && detected.marked.marks[i] != 0;
    wrong += truth.marks[i] == 0 && detected.marked.marks[i] != 0;
  }
  EXPECT_GE(found, spikes * 8 / 10);
  EXPECT_LE(wrong, 4U);
  EXPECT_NEAR(detected.noise[0], 1.5, 0.15);
}

TEST(FindSpikes, ASuddenStopIsNoSpike) {
  Random random(5);
  VectorTracks tracks(240, 1);
  for (std::size_t t = 0; t < 240; ++t) {
    const double angle =
        t < 120 ? 15.0 * static_cast<double>(t) : 15.0 * 119;  // 1,800 degrees a second, then still
    tracks.set(t, 0, Vec3{angle, 0, 0} + 0.5 * test::random_vector(random));
  }
  const DetectedSpikes detected = find_spikes(tracks, SampleMarks(240, 1), {{}}, chart_rate_hz);
  for (std::size_t t = 0; t < 240; ++t) EXPECT_EQ(detected.marked(t, 0), 0) << "frame " << t;
}

TEST(FindSpikes, OnAQuietTakeOnlyWhatExceedsTheSpeedOfJoints) {
  Random random(6);
  VectorTracks tracks = noisy_curves(500, {0.02, 0.02}, random);
  const auto push = [&](std::size_t t, std::size_t n, double degrees) {
    tracks.set(t, n, tracks.at(t, n) + Vec3{0, degrees, 0});
  };
  push(100, 0, 170);  // a flip
  push(300, 1, 20);   // within the speed of joints
  const DetectedSpikes detected = find_spikes(tracks, SampleMarks(500, 2), {{}, {}}, chart_rate_hz);
  EXPECT_EQ(detected.marked(100, 0), 1);
  EXPECT_EQ(detected.marked(300, 1), 0);
  EXPECT_EQ(std::count(detected.marked.marks.begin(), detected.marked.marks.end(), 1), 1);
}

// Returns whether a fast motion of 15 degrees is marked among forty spikes on quiet tracks.
bool finds_fast_motion_among(const std::function<double(Random&)>& size_of_spikes) {
  Random random(8);
  const std::size_t frames = 500, count = 8;
  VectorTracks tracks = noisy_curves(frames, std::vector<double>(count, 0.02), random);
  const auto push = [&](std::size_t t, std::size_t n, double degrees) {
    const Vec3 direction = test::random_vector(random);
    tracks.set(t, n, tracks.at(t, n) + degrees / norm(direction) * direction);
  };
  for (std::size_t i = 0; i < 40; ++i) push(20 + 11 * i, i % count, size_of_spikes(random));
  push(253, 3, 15);
  const DetectedSpikes detected =
      find_spikes(tracks, SampleMarks(frames, count), std::vector<std::vector<std::size_t>>(count),
                  chart_rate_hz);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(detected.marked(20 + 11 * i, i % count), 1) << i;
  return detected.marked(253, 3) != 0;
}

TEST(FindSpikes, WhatIsFarSmallerThanAllSpikesIsMotion) {
  EXPECT_FALSE(finds_fast_motion_among([](Random&) { return 60.0; }));
  EXPECT_TRUE(finds_fast_motion_among([](Random& random) { return 12 + 80 * random.uniform(); }));
}

TEST(GrossSpikes, AreReplacedByTheMeanOfTheirNeighbours) {
  std::vector<Quat> track = turning_track(100);
  const std::vector<Quat> truth = track;
  for (const std::size_t t : {0U, 40U, 99U}) track[t] = track[t] * exp({0, 0, 1.2});
  const std::vector<std::uint8_t> marks = replace_gross_spikes(track);
  for (std::size_t t = 0; t < 100; ++t) {
    EXPECT_EQ(marks[t] != 0, t == 0 || t == 40 || t == 99) << "frame " << t;
    EXPECT_LT(angle_between(track[t], truth[t]), 0.05) << "frame " << t;
  }
}

TEST(JointsNearby, AreThoseWithinThreeBones) {
  // Joints 0 - 1 - 2 - 3 - 4 form a chain, and 5 is a child of 0.
  const std::vector<std::int32_t> parents{-1, 0, 1, 2, 3, 0};
  auto nearby = joints_nearby(parents);
  for (auto& list : nearby) std::sort(list.begin(), list.end());
  EXPECT_EQ(nearby[0], (std::vector<std::size_t>{1, 2, 3, 5}));
  EXPECT_EQ(nearby[4], (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(nearby[5], (std::vector<std::size_t>{0, 1, 2}));
}

TEST(ReadTracks, GivesTheVectorsOfEachTrackAndMarksItsGaps) {
  Take clip = synthesize({});
  clip.observed.assign(clip.rotations.size(), 1);
  clip.observed[10 * clip.joint_count() + 2] = 0;
  const TakeView take = view_of(clip);
  const TracksRead read = read_tracks(take, {1, 2}, true);
  const TrackVectors own = vectors_of(take, 2);
  EXPECT_TRUE(std::ranges::equal(read.vectors.track(1), own.vectors));
  EXPECT_TRUE(std::ranges::equal(read.suspects.track(1), own.suspects));
  for (std::size_t t = 0; t < take.frames; ++t) {
    EXPECT_EQ(read.gaps(t, 0), 0) << "frame " << t;
    EXPECT_EQ(read.gaps(t, 1), t == 10 ? 1 : 0) << "frame " << t;
  }
  ASSERT_TRUE(read.charts[1].has_value());
  EXPECT_EQ(read.charts[1]->path, own.chart->path);
  EXPECT_TRUE(read_tracks(take, {1, 2}, false).charts.empty());
}

TEST(SmoothRamp, RisesFromItsStartToItsEnd) {
  EXPECT_EQ(smooth_ramp(1, 2, 4), 0);
  EXPECT_EQ(smooth_ramp(2, 2, 4), 0);
  EXPECT_EQ(smooth_ramp(2.5, 2, 4), 0.15625);
  EXPECT_EQ(smooth_ramp(3, 2, 4), 0.5);
  EXPECT_EQ(smooth_ramp(4, 2, 4), 1);
  EXPECT_EQ(smooth_ramp(9, 2, 4), 1);
}

TEST(SmoothTracks, LeavesTracksOfShareZeroAndShortTakesAlone) {
  Random random(7);
  VectorTracks tracks = noisy_curves(100, {1.0, 1.0}, random);
  const VectorTracks before = tracks;
  smooth_tracks(tracks, SampleMarks(100, 2), std::vector<double>{1, 1}, std::vector<double>{0, 1},
                chart_rate_hz);
  double change = 0;
  for (std::size_t t = 0; t < 100; ++t) {
    EXPECT_EQ(tracks.at(t, 0), before.at(t, 0));
    change += norm(tracks.at(t, 1) - before.at(t, 1));
  }
  EXPECT_GT(change, 50);
  VectorTracks tiny = noisy_curves(3, {1.0}, random);
  const VectorTracks tiny_before = tiny;
  smooth_tracks(tiny, SampleMarks(3, 1), std::vector<double>{1}, std::vector<double>{1},
                chart_rate_hz);
  EXPECT_EQ(tiny.values, tiny_before.values);
}

TEST(SmoothTracks, TurningTheTracksTurnsTheResult) {
  Random random(8);
  VectorTracks tracks = noisy_curves(200, {1.5}, random), turned(200, 1);
  const Quat turn = exp({0.4, -1.1, 0.7});
  for (std::size_t t = 0; t < 200; ++t) turned.set(t, 0, rotate(turn, tracks.at(t, 0)));
  const SampleMarks none(200, 1);
  smooth_tracks(tracks, none, std::vector<double>{1.5}, std::vector<double>{1}, chart_rate_hz);
  smooth_tracks(turned, none, std::vector<double>{1.5}, std::vector<double>{1}, chart_rate_hz);
  double largest = 0;
  for (std::size_t t = 0; t < 200; ++t) {
    largest = std::max(largest, norm(turned.at(t, 0) - rotate(turn, tracks.at(t, 0))));
  }
  EXPECT_LT(largest, 1e-4);
}

}  // namespace
}  // namespace kinemend
