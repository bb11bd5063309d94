// Tests of measured noise in reports, and of noise given as known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinemend/check.hpp"
#include "kinemend/error.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "quality/lower_rate.hpp"
#include "quality/quality.hpp"

namespace kinemend::quality {
namespace {

Take walk(std::size_t seconds = 6) {
  return synthesize({.motion = "walk", .duration_s = static_cast<double>(seconds)});
}

Take with_noise(Take clip, double deviation_deg, double correlation, std::uint64_t seed) {
  Random random(seed);
  apply_damage(clip, "ar1", {{"std_deg", deviation_deg}, {"correlation", correlation}}, random);
  return clip;
}

CleanReport report_of(const Take& clip, const CleanSettings& settings = {}) {
  return clean_take(clip, *make_cleaner("auto"), settings).report;
}

double error_of(const Take& truth, const Take& noisy, const CleanSettings& settings = {}) {
  return figures(truth, clean_take(noisy, *make_cleaner("auto"), settings).take).rms;
}

std::size_t lost_peaks(const CleanReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.warnings.begin(), report.warnings.end(), [](const std::string& words) {
        return words.find("peak speed falls") != std::string::npos;
      }));
}

TEST(NoiseFound, HasTheStrengthAndTheColourOfTheNoise) {
  const CleanReport white = report_of(with_noise(walk(), 1.5, 0, 1));
  ASSERT_FALSE(white.noise.empty());
  EXPECT_EQ(white.noise[0].space, Space::rotation);
  EXPECT_EQ(white.noise[0].correlation, 0);
  EXPECT_NEAR(white.noise[0].strength, 1.5, 0.15);
  const CleanReport slow = report_of(with_noise(walk(), 1.5, 0.8, 1));
  ASSERT_FALSE(slow.noise.empty());
  EXPECT_NEAR(slow.noise[0].correlation, 0.8, 0.11);
  EXPECT_NEAR(slow.noise[0].strength, 1.5, 0.4);
  EXPECT_EQ(slow.noise[0].frames_per_sample, 1U);
}

TEST(NoiseFound, SaysThatFramesAreSamplesOfALowerRate) {
  for (const bool is_held : {true, false}) {
    const Take clip = of_lower_rate(with_noise(walk(), 1.5, 0, 2), is_held ? 2 : 4, is_held);
    const CleanReport report = report_of(clip);
    ASSERT_FALSE(report.noise.empty());
    EXPECT_EQ(report.noise[0].frames_per_sample, is_held ? 2U : 4U);
    EXPECT_EQ(report.noise[0].is_interpolated, !is_held);
  }
}

TEST(NoiseFound, IsNoneOfACleanTake) { EXPECT_TRUE(report_of(walk()).noise.empty()); }

TEST(NoiseFound, IsWhatACheckFindsBeforeCleaning) {
  const Take clip = with_noise(walk(), 1.5, 0.8, 3);
  const CleanReport cleaned = report_of(clip);
  const CheckReport checked = check_take(clip);
  ASSERT_EQ(checked.noise.size(), cleaned.noise.size());
  EXPECT_EQ(checked.noise[0].correlation, cleaned.noise[0].correlation);
  EXPECT_EQ(checked.noise[0].strength, cleaned.noise[0].strength);
}

// Speeds over a few frames are smaller for correlated noise than for white noise with the same
// highest frequencies.
TEST(NoiseFound, SlowNoiseThatGoesIsNoPeakThatFalls) {
  for (const double correlation : {0.0, 0.8, 0.95}) {
    const CleanReport report = report_of(with_noise(walk(), 1.5, correlation, 4));
    EXPECT_EQ(lost_peaks(report), 0U) << correlation;
  }
}

TEST(KnownNoise, IsGoneByInPlaceOfWhatIsFound) {
  const Take truth = walk(), noisy = with_noise(truth, 1.5, 0.8, 5);
  CleanSettings white;
  white.noise.emplace();
  // The report states the measured noise, even if another one is given.
  EXPECT_EQ(report_of(noisy, white).noise.at(0).correlation,
            report_of(noisy).noise.at(0).correlation);
  EXPECT_GT(error_of(truth, noisy, white), 1.2 * error_of(truth, noisy));

  CleanSettings known;
  known.noise = KnownNoise{0.8, {}};
  for (const std::string& name : truth.skeleton.names) known.noise->strengths[name] = 1.5;
  EXPECT_LT(error_of(truth, noisy, known), 1.03 * error_of(truth, noisy));
}

// One second alone is too short to measure the noise.
TEST(KnownNoise, OfALongTakeServesAShortOneOfTheSameSystem) {
  const CleanReport found = report_of(with_noise(walk(8), 1.5, 0.8, 6));
  CleanSettings known;
  known.noise = KnownNoise{found.noise.at(0).correlation, {}};
  for (const TrackSummary& track : found.tracks) {
    if (track.noise > 0) known.noise->strengths[track.name] = track.noise;
  }
  const Take truth = walk(1), noisy = with_noise(truth, 1.5, 0.8, 7);
  EXPECT_LE(error_of(truth, noisy, known), 1.02 * error_of(truth, noisy));
}

TEST(KnownNoise, OutOfItsRangeIsRefused) {
  CleanSettings settings;
  for (const double correlation : {-0.1, 1.0, std::nan("")}) {
    settings.noise = KnownNoise{correlation, {}};
    EXPECT_THROW(report_of(walk(1), settings), Error) << correlation;
  }
  for (const double strength : {0.0, -1.0, std::nan("")}) {
    settings.noise = KnownNoise{0, {{"Hips", strength}}};
    EXPECT_THROW(report_of(walk(1), settings), Error) << strength;
  }
}

}  // namespace
}  // namespace kinemend::quality
