// Tests of the noise floor as a bound, offline and live.
#include "methods/learned/noise_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

// Degrees subtracted from each axis, by frame and track.
using Removal = std::function<double(std::size_t frame, std::size_t track)>;

struct Case {
  MotionTake take;
  MotionResult result;
};

// Swinging tracks; the result subtracts the given removal.
Case case_of(std::size_t frames, std::size_t tracks, const Removal& removal,
             double frame_rate_hz = 120) {
  Case both;
  MotionTake& take = both.take;
  take.frames = frames;
  take.channels = 3 * tracks;
  take.frame_rate_hz = frame_rate_hz;
  take.is_position.assign(take.channels, 0);
  take.slots.assign(take.channels, -1);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t c = 0; c < take.channels; ++c)
      take.values.push_back(static_cast<float>(
          10 * std::sin(2 * static_cast<double>(f) / frame_rate_hz + static_cast<double>(c))));
  }
  take.measured = take.values;
  both.result = {take.values, std::vector<float>(take.values.size(), 0.01F)};
  for (std::size_t f = 0; f < frames; ++f)
    for (std::size_t c = 0; c < take.channels; ++c)
      both.result.values[f * take.channels + c] -= static_cast<float>(removal(f, c / 3));
  return both;
}

double lost_at(const Case& both, std::size_t frame, std::size_t track) {
  const std::size_t i = frame * both.take.channels + 3 * track;
  return std::abs(static_cast<double>(both.take.values[i] - both.result.values[i]));
}

std::vector<double> bound(Case& both, bool is_known = false, bool is_stepped = false) {
  const std::size_t tracks = both.take.channels / 3;
  const std::vector<std::uint8_t> known(tracks, is_known ? 1 : 0), stepped(tracks, is_stepped);
  return keep_to_noise_floor(both.take, known, stepped, both.result);
}

Case bound_live(const Case& both) {
  Case bounded = both;
  const std::size_t channels = both.take.channels;
  LiveNoiseFloor floor(both.take.frame_rate_hz, std::vector<std::uint8_t>(channels / 3, 1));
  const std::vector<std::uint8_t> of_body(channels / 3, 0);
  for (std::size_t f = 0; f < both.take.frames; ++f) {
    floor.bound(std::span(both.take.values).subspan(f * channels, channels), false, of_body,
                std::span(bounded.result.values).subspan(f * channels, channels));
  }
  return bounded;
}

// Slow noise: a 60th of a second later it has hardly changed.
double slow(std::size_t frame) { return 2 + std::sin(0.05 * static_cast<double>(frame)); }
// A fast move of half a second whose peak a smoother would cut off.
double peak(std::size_t frame) {
  return frame >= 600 && frame < 660
             ? 5 * std::sin(3.14159265358979 * static_cast<double>(frame - 600) / 60)
             : 0;
}
constexpr std::size_t at_peak = 630;

TEST(NoiseFloor, KeepsThePeakOfAMoveInATrackThatIsQuietElsewhere) {
  Case both = case_of(1200, 1, [](std::size_t f, std::size_t) { return peak(f); });
  ASSERT_GT(lost_at(both, at_peak, 0), 4.9);
  const std::vector<double> put_back = bound(both);
  EXPECT_LT(lost_at(both, at_peak, 0), 1e-6);
  EXPECT_GT(put_back[0], 0.5);
}

TEST(NoiseFloor, LeavesSlowNoiseOfALongTrackAsItIsTakenOut) {
  Case both = case_of(1200, 1, [](std::size_t f, std::size_t) { return slow(f); });
  const MotionResult before = both.result;
  EXPECT_EQ(bound(both)[0], 0);
  EXPECT_EQ(both.result.values, before.values);
}

TEST(NoiseFloor, LetsAMomentOfANoisyTrackLoseTwiceItsFloor) {
  Case both = case_of(1200, 1, [](std::size_t f, std::size_t) { return 1 + 2 * peak(f); });
  bound(both);
  EXPECT_LT(lost_at(both, at_peak, 0), 3);
  EXPECT_GT(lost_at(both, at_peak, 0), 1.5);
  EXPECT_NEAR(lost_at(both, 100, 0), 1, 1e-5);
}

TEST(NoiseFloor, SeesNoneOfAShortTrackUnlessTheModelKnowsItOrNoiseIsMeasured) {
  const auto short_case = [] {
    return case_of(360, 1, [](std::size_t f, std::size_t) { return slow(f); });
  };
  Case unknown = short_case(), known = short_case(), measured = short_case();
  for (float& value : measured.take.measured) value += 0.1F;
  bound(unknown);
  bound(known, true);
  bound(measured);
  EXPECT_LT(lost_at(unknown, 180, 0), 1e-6);
  EXPECT_GT(lost_at(known, 180, 0), 1);
  EXPECT_GT(lost_at(measured, 180, 0), 1);
}

TEST(NoiseFloor, LetsAMomentLoseWhatTheMeasuredNoiseAsksFor) {
  Case both = case_of(1200, 1, [](std::size_t f, std::size_t) { return peak(f); });
  for (std::size_t i = 0; i < both.take.values.size(); ++i)
    both.take.measured[i] -= static_cast<float>(0.5 * peak(i / 3));
  bound(both);
  EXPECT_NEAR(lost_at(both, at_peak, 0), 2.5, 1e-3);
}

TEST(NoiseFloor, DoesNotTrustAMeasurementOfAShortTakeOfALowRate) {
  const auto keyed = [](double frame_rate_hz) {
    Case both = case_of(
        60, 1, [](std::size_t f, std::size_t) { return f > 20 && f < 26 ? 4.0 : 0.0; },
        frame_rate_hz);
    both.take.measured = both.result.values;
    return both;
  };
  Case slow_rate = keyed(30), high_rate = keyed(60);
  bound(slow_rate);
  bound(high_rate);
  EXPECT_LT(lost_at(slow_rate, 23, 0), 1e-6);
  EXPECT_GT(lost_at(high_rate, 23, 0), 3.9);
}

TEST(NoiseFloor, LetsABurstOfWhiteNoiseGoAndKeepsAFlip) {
  Random random(3);
  const auto noise = [&](std::size_t f) { return f >= 600 && f < 780 ? 2 * random.normal() : 0.0; };
  Case burst = case_of(1200, 1, [&](std::size_t f, std::size_t) { return noise(f); });
  const double before = lost_at(burst, 690, 0);
  bound(burst);
  EXPECT_EQ(lost_at(burst, 690, 0), before);
  Case flip = case_of(1200, 1, [](std::size_t f, std::size_t) { return f == 690 ? 70.0 : 0.0; });
  bound(flip);
  EXPECT_LT(lost_at(flip, 690, 0), 1e-6);
}

TEST(NoiseFloor, LeavesAShortTakeAloneInWhichMostTracksHaveAFloor) {
  const auto with_quiet_tracks = [](std::size_t quiet) {
    return case_of(
        240, 10, [quiet](std::size_t f, std::size_t track) { return track < quiet ? 0 : slow(f); });
  };
  Case noisy = with_quiet_tracks(2), clean = with_quiet_tracks(5);
  bound(noisy);
  bound(clean);
  EXPECT_GT(lost_at(noisy, 120, 9), 1);
  EXPECT_LT(lost_at(clean, 120, 9), 1e-6);
}

TEST(NoiseFloor, TakesNoStepsForNoiseUnlessNoiseIsMeasured) {
  Case stepped = case_of(1200, 10, [](std::size_t f, std::size_t) { return slow(f); }),
       noisy = stepped;
  for (float& value : noisy.take.measured) value += 0.1F;
  bound(stepped, false, true);
  bound(noisy, false, true);
  EXPECT_LT(lost_at(stepped, 600, 0), 1e-6);
  EXPECT_GT(lost_at(noisy, 600, 0), 1);
}

TEST(NoiseFloor, CountsNoSamplesThatAreMissing) {
  Case both = case_of(1200, 1, [](std::size_t f, std::size_t) { return f < 400 ? 50.0 : 1.0; });
  both.take.missing.assign(both.take.values.size(), 0);
  for (std::size_t i = 0; i < 3 * 400; ++i) both.take.missing[i] = 1;
  EXPECT_EQ(bound(both)[0], 0);
}

TEST(LiveNoiseFloor, KeepsThePeakOfAMoveInATrackThatIsQuietElsewhere) {
  const Case both =
      bound_live(case_of(1200, 1, [](std::size_t f, std::size_t) { return peak(f); }));
  EXPECT_LT(lost_at(both, at_peak, 0), 1e-6);
}

TEST(LiveNoiseFloor, TakesSlowNoiseOutWhenItHasSeenFourSecondsOfIt) {
  const Case both =
      bound_live(case_of(1200, 1, [](std::size_t f, std::size_t) { return slow(f); }));
  EXPECT_LT(lost_at(both, 400, 0), 1e-6);
  EXPECT_NEAR(lost_at(both, 1000, 0), slow(1000), 1e-5);
}

TEST(LiveNoiseFloor, TakesItOutOfAllTracksSoonerWhereMostHaveIt) {
  const Case both = bound_live(
      case_of(1200, 10, [](std::size_t f, std::size_t track) { return track < 2 ? 0 : slow(f); }));
  EXPECT_NEAR(lost_at(both, 380, 9), slow(380), 1e-5);
}

TEST(LiveNoiseFloor, LetsWhiteNoiseGoAfterAQuarterOfASecond) {
  Random random(3);
  const Case before =
      case_of(240, 1, [&](std::size_t, std::size_t) { return 2 * random.normal(); });
  const Case after = bound_live(before);
  for (std::size_t f = 60; f < 240; ++f)
    EXPECT_EQ(lost_at(after, f, 0), lost_at(before, f, 0)) << f;
}

}  // namespace
}  // namespace kinemend
