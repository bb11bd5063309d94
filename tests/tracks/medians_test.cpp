#include "tracks/medians.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clean/takes.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/random.hpp"
#include "metrics/track_noise.hpp"

namespace kinemend::test {
namespace {

std::vector<Quat> scattered(std::size_t count, double size, Random& random) {
  std::vector<Quat> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    samples.push_back(exp({0.4, 2.5, -0.2}) * exp({size * x, size * y, size * z}));
    if (random.chance(0.5)) samples.back() = -samples.back();
  }
  return samples;
}

double sum_of_chords(std::span<const Quat> samples, Quat point) {
  double sum = 0;
  for (const Quat& q : samples) sum += 4 * std::sin(angle_between(q, point) / 4);
  return sum;
}

TEST(Medians, AChordIsTheAngleForSmallTurnsAndKnowsNoSigns) {
  EXPECT_NEAR(chord(exp({0.01, 0, 0}), exp({0.03, 0, 0})), 0.02, 1e-6);
  EXPECT_NEAR(chord({1, 0, 0, 0}, {-1, 0, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(chord(exp({1, 0, 0}), -exp({0, 1, 0})),
              4 * std::sin(angle_between(exp({1, 0, 0}), exp({0, 1, 0})) / 4), 1e-12);
}

TEST(Medians, TheMedoidHasTheLeastSumOfAllSamples) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const auto samples = scattered(3 + random.below(20), 0.5, random);
    const double found = sum_of_chords(samples, samples[medoid(samples)]);
    for (const Quat& q : samples) EXPECT_LE(found, sum_of_chords(samples, q) + 1e-12);
  }
}

TEST(Medians, AMovingMedoidIsThatOfEachWindow) {
  Random random(2);
  const auto track = scattered(80, 0.3, random);
  MovingMedoid<Quat> moving(track, 11);
  for (std::size_t t = 0; t < 80; ++t) {
    const std::size_t first = t - std::min<std::size_t>(t, 5),
                      last = std::min<std::size_t>(79, t + 5);
    const auto window = std::span<const Quat>(track).subspan(first, last - first + 1);
    const std::size_t found = moving.find(first, last);
    EXPECT_EQ(found, first + medoid(window)) << t;
    for (std::size_t f = first; f <= last; ++f) {
      EXPECT_NEAR(moving.distance(found, f), chord(track[found], track[f]), 1e-15);
    }
  }
}

TEST(Medians, NoPointNearbyHasASmallerSumThanTheMedian) {
  Random random(3);
  std::vector<Vec3> scratch;
  for (int trial = 0; trial < 50; ++trial) {
    const auto samples = scattered(3 + random.below(12), 0.1, random);
    const Quat median = l1_median(samples, medoid(samples), scratch);
    const double found = sum_of_chords(samples, median);
    for (int probe = 0; probe < 50; ++probe) {
      const double size = 0.1 * random.uniform();
      const Vec3 step{size * random.normal(), size * random.normal(), size * random.normal()};
      EXPECT_LE(found, sum_of_chords(samples, median * exp(step)) + 1e-5);
    }
  }
}

TEST(Medians, AMajorityInOnePlaceIsTheMedian) {
  std::vector<Vec3> scratch;
  const Quat q = exp({0.1, 0.2, 0.3});
  const std::vector<Quat> samples{q, exp({2, 0, 0}), -q, q, exp({0, -1, 0})};
  EXPECT_LT(angle_between(l1_median(samples, medoid(samples), scratch), q), 1e-12);
}

TEST(Medians, ThreePointsOnACircleHaveTheirMedianInTheMiddle) {
  std::vector<Vec3> scratch;
  const std::vector<Vec3> samples{
      {1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}};
  EXPECT_LT(norm(l1_median(samples, medoid(samples), scratch)), 1e-3);
}

TEST(Medians, AreTheSameInAnyCoordinateFrame) {
  Random random(4);
  std::vector<Vec3> scratch;
  const Quat left = exp({1, 2, 0.5}), right = exp({-0.3, 1, 1});
  const auto samples = scattered(9, 0.2, random);
  std::vector<Quat> turned;
  for (const Quat& q : samples) turned.push_back(left * q * right);
  const Quat a = l1_median(samples, medoid(samples), scratch);
  const Quat b = l1_median(turned, medoid(turned), scratch);
  EXPECT_LT(angle_between(left * a * right, b), 1e-9);
}

TEST(Median, RemovesASpikeAndKeepsAStep) {
  Clip clip = empty_take(60, 100);
  for (std::size_t f = 0; f < 60; ++f) {
    clip.rotation(f, 1) = f < 30 ? exp({0.2, 0, 0}) : exp({0, 0.9, 0});
    clip.root_positions[f] = f < 30 ? Vec3{1, 2, 3} : Vec3{5, 2, 3};
  }
  const Clip truth = clip;
  for (const std::size_t f : {0, 12, 45, 59}) {
    clip.rotation(f, 1) = clip.rotation(f, 1) * exp({0, 0, 1});
    clip.root_positions[f] += {0, 9, 0};
  }
  make_median({.window_s = 0.05})->clean(clip, Selection::all(clip));
  EXPECT_LT(max_angle_deg(clip, truth), 1e-9);
  for (std::size_t f = 0; f < 60; ++f)
    EXPECT_LT(norm(clip.root_positions[f] - truth.root_positions[f]), 1e-9);
}

TEST(Hampel, ReplacesTheSpikesAndLeavesEveryOtherSampleByteForByte) {
  const Clip truth = moving_take(240, 120);
  Clip clip = truth;
  const std::vector<std::size_t> spikes{0, 17, 80, 81, 160, 239};
  for (const std::size_t f : spikes) {
    clip.rotation(f, 1) = clip.rotation(f, 1) * exp({0.5, -0.3, 0.2});
    clip.root_positions[f] += {20, 0, 0};
  }
  const CleanResult result = clean_clip(clip, *make_hampel());
  std::vector<std::size_t> changed, moved;
  for (std::size_t f = 0; f < 240; ++f) {
    if (result.clip.rotation(f, 1) != clip.rotation(f, 1)) changed.push_back(f);
    if (result.clip.root_positions[f] != clip.root_positions[f]) moved.push_back(f);
    for (const std::size_t j : {0, 2, 3, 4, 5, 6})
      ASSERT_EQ(result.clip.rotation(f, j), clip.rotation(f, j));
  }
  EXPECT_EQ(changed, spikes);
  EXPECT_EQ(moved, spikes);
  EXPECT_LT(max_angle_deg(result.clip, truth), 4);
  EXPECT_EQ(result.report.joints[1].frames_repaired, spikes.size());
}

TEST(Hampel, DoesNotTakeAFastMotionForASpike) {
  Clip clip = empty_take(120, 120);
  for (std::size_t f = 0; f < 120; ++f) {
    const double t = static_cast<double>(f) / 120;
    clip.rotation(f, 1) = exp({1.2 * std::sin(2 * pi * 4 * t), 0, 0});  // 1,700 degrees a second
    clip.rotation(f, 2) = exp({0, t < 0.5 ? 0 : 12 * (t - 0.5), 0});    // a start without warning
  }
  const Clip output = clean_clip(clip, *make_hampel()).clip;
  EXPECT_EQ(output.local_rotations, clip.local_rotations);
}

TEST(Hampel, LeavesSmallDeviationsAlone) {
  Clip clip = empty_take(60, 120);
  clip.rotation(30, 1) = exp({0.9 * radians_per_degree, 0, 0});
  EXPECT_EQ(clean_clip(clip, *make_hampel()).clip.rotation(30, 1), clip.rotation(30, 1));
  EXPECT_EQ(clean_clip(clip, *make_hampel({.minimum_deg = 0.8})).clip.rotation(30, 1), Quat{});
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
