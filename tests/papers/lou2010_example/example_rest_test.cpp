// Tests how `example` treats noise, strange motion, and motion outside its bases.
#include "methods/prior/prior_fall_backs.hpp"
#include "papers/lou2010_example/example_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinemend/extend/random.hpp"

namespace kinemend::test {
namespace {

constexpr std::size_t frames = 200, channels = 6;

// Smooth motion with noise of standard deviation `noise`; the result of `auto` is the motion
// itself.
PriorWork work_of(double noise, std::uint64_t seed = 1) {
  Random random(seed);
  PriorWork work;
  work.channels.frame_rate_hz = 30;
  work.channels.poses = PoseMatrix(frames, channels);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t c = 0; c < channels; ++c) {
      work.channels.poses(f, c) =
          10 * std::sin(0.05 * static_cast<double>(f) + static_cast<double>(c));
    }
  }
  work.fallback = work.channels.poses;
  for (double& value : work.channels.poses.values) value += noise * random.normal();
  work.channels.observed.assign(frames * channels, 1);
  work.suspect.assign(frames * channels, 0);
  work.noise.assign(channels, noise);
  work.needs.assign(channels / 3, 1);
  return work;
}

double mean_square(const PoseMatrix& a, const PoseMatrix& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
  return sum / static_cast<double>(a.values.size());
}

TEST(ExampleNoise, IsTheMeasuredOne) {
  const PriorWork work = work_of(2);
  const std::vector<double> levels = example_noise(work);
  ASSERT_EQ(levels.size(), work.noise.size());
  for (const double level : levels) EXPECT_NEAR(level, 2, 1e-12);
}

TEST(ExampleNoise, IsTheTypicalOneWhereNothingIsKnown) {
  PriorWork work = work_of(2);
  work.noise[3] = work.noise[4] = work.noise[5] = 0;
  EXPECT_NEAR(example_noise(work)[4], 2, 1e-12);
  work.noise.assign(channels, 0);
  EXPECT_NEAR(example_noise(work)[4], 0.05, 1e-12);
}

// The motion outside the bases has 100 times its variance in training.
TEST(Strangeness, IsTheVarianceOutsideOfTheBasesOverThatOfTraining) {
  const PriorWork work = work_of(1);
  Random random(2);
  PoseMatrix expressed = work.fallback;
  for (double& value : expressed.values) value += 2 * random.normal();
  const std::vector<double> noise(channels, 1.0), residual(channels, 0.04);
  EXPECT_NEAR(strangeness(work, work.channels.poses, expressed, noise, residual), 100, 12);
  // Noise alone is not strange.
  EXPECT_EQ(strangeness(work, work.channels.poses, work.fallback, noise, residual), 1);
}

TEST(FallBack, TakesWhatAutoMadeOfStrangeMotionButFillsNoGaps) {
  PriorWork work = work_of(1);
  work.channels.observed[0] = 0;
  const PoseMatrix filtered(frames, channels, 5.0);
  PoseMatrix known = filtered, between = filtered, unknown = filtered;
  fall_back(work, 1.2, known);
  EXPECT_EQ(known.values, filtered.values);
  fall_back(work, 1000, unknown);
  EXPECT_EQ(unknown(0, 0), 5);
  EXPECT_NEAR(unknown(1, 0), work.fallback(1, 0), 1e-12);
  fall_back(work, std::sqrt(1.5 * 5), between);
  EXPECT_NEAR(between(1, 0), 0.5 * (5 + work.fallback(1, 0)), 1e-9);
}

// From frame 100 on, the result is off the measurement by `deviations` noise deviations. Below one,
// `auto` is ignored; beyond two, it is used fully; at 1.5, by half.
TEST(FallBack, TakesWhatAutoMadeOfAPartWhereTheResultIsBiased) {
  const std::vector<double> noise(channels, 1.0);
  for (const auto& [deviations, taken] : {std::pair{0.9, 0.0}, {1.5, 0.5}, {2.1, 1.0}}) {
    PriorWork work = work_of(0);
    work.channels.observed[150 * channels] = 0;
    for (double& value : work.fallback.values) value += 10;
    PoseMatrix cleaned = work.channels.poses;
    for (std::size_t f = 100; f < frames; ++f) {
      for (std::size_t c = 0; c < 3; ++c) cleaned(f, c) += deviations;
    }
    PoseMatrix result = cleaned;
    fall_back_where_biased(work, noise, result);
    EXPECT_EQ(result(50, 0), cleaned(50, 0));
    EXPECT_EQ(result(150, 3), cleaned(150, 3)) << "another part";
    EXPECT_EQ(result(150, 0), cleaned(150, 0)) << "a gap";
    EXPECT_NEAR(result(151, 0) - cleaned(151, 0), taken * (10 - deviations), 1e-9) << deviations;
  }
}

// Bases of one constant pattern in one channel represent almost no motion. The rest is kept and
// smoothed, and lies nearer to the truth than the measurements.
TEST(SmoothRest, KeepsSmoothMotionThatTheBasesDoNotKnow) {
  PriorWork work = work_of(1);
  WindowBases bases;
  bases.frames = 10;
  bases.channels = channels;
  bases.count = 1;
  bases.hop = 1;
  bases.values.assign(10 * channels, 0);
  for (std::size_t f = 0; f < 10; ++f) bases.values[f * channels] = 1 / std::sqrt(10.0);
  const std::vector<double> mean(channels, 0.0), noise(channels, 1.0);
  PoseMatrix weights(frames, channels, 1.0), cleaned = work.channels.poses;
  // A rejected sample is ignored.
  work.channels.poses(50, 1) += 1000;
  weights(50, 1) = 0;
  smooth_rest(work, weights, filter_linearly(cleaned, bases, mean), noise, cleaned);
  EXPECT_LT(mean_square(cleaned, work.fallback), 0.3);
  EXPECT_NEAR(cleaned(50, 1), work.fallback(50, 1), 2);
}

// In a gap at the end, the filter's filling is kept, whatever the motion beside it.
TEST(SmoothRest, LeavesLongGapsAsTheFilterFilledThem) {
  PriorWork work = work_of(0.1);
  WindowBases bases;
  bases.frames = 10;
  bases.channels = channels;
  bases.count = 1;
  bases.hop = 1;
  bases.values.assign(10 * channels, 0);
  const std::vector<double> mean(channels, 0.0), noise(channels, 0.1);
  const PoseMatrix weights(frames, channels, 1.0);
  PoseMatrix cleaned = work.channels.poses;
  for (std::size_t f = 120; f < 160; ++f) {
    work.channels.observed[f * channels + 1] = 0;
    cleaned(f, 1) = 0;
  }
  smooth_rest(work, weights, filter_linearly(cleaned, bases, mean), noise, cleaned);
  for (std::size_t f = 130; f < 150; ++f) EXPECT_NEAR(cleaned(f, 1), 0, 1.5) << f;
}

}  // namespace
}  // namespace kinemend::test
