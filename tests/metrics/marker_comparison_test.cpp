// Tests of the comparison of marker takes: fits, lags, and samples missing in one take.
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend {
namespace {

constexpr double rate_hz = 60;
constexpr std::size_t frames = 600;

double seconds(std::size_t frame) { return static_cast<double>(frame) / rate_hz; }

Vec3 path(double s, std::size_t marker) {
  const double phase = static_cast<double>(marker);
  return {300 * std::sin(1.3 * s + phase), 500 + 80 * std::cos(2.1 * s + 2 * phase),
          200 * phase + 150 * std::sin(0.7 * s)};
}

// A take whose samples are `place(p, frame, marker)` for each reference sample p.
template <class Place>
Take take_of(const Place& place, std::size_t count = frames) {
  Take clip;
  clip.names = {"LASI", "RASI", "C7"};
  clip.frame_rate_hz = rate_hz;
  clip.unit = "mm";
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t m = 0; m < 3; ++m) clip.positions.push_back(place(path(seconds(f), m), f, m));
  }
  clip.observed.assign(clip.positions.size(), 1);
  return clip;
}

Take reference() {
  return take_of([](Vec3 p, std::size_t, std::size_t) { return p; });
}

MarkerComparison compared(const Take& other, MarkerFit fit = MarkerFit::none) {
  MarkerComparisonSettings settings;
  settings.fit = fit;
  return compare_markers(reference(), other, settings);
}

TEST(CompareMarkers, ATakeWithItselfHasNoError) {
  const MarkerComparison same = compared(reference());
  EXPECT_EQ(same.frames, frames);
  EXPECT_EQ(same.names, reference().names);
  EXPECT_EQ(same.all.samples, 3 * frames);
  EXPECT_EQ(same.all.rms_distance, 0);
  EXPECT_EQ(same.all.velocity_rms, 0);
  EXPECT_EQ(same.p99_distance, 0);
  EXPECT_NEAR(same.lag_s, 0, 1e-9);
  EXPECT_TRUE(same.unmatched.empty());
}

// The error a sin(w t) along x has the mean square a^2 / 2 and the central difference a sin(w /
// rate) rate cos(w t).
TEST(CompareMarkers, ASineHasTheFiguresOfItsClosedForm) {
  const double amplitude = 7, frequency_hz = 4, w = 2 * pi * frequency_hz;
  const MarkerComparison c = compared(take_of([&](Vec3 p, std::size_t f, std::size_t) {
    return p + Vec3{amplitude * std::sin(w * seconds(f)), 0, 0};
  }));
  EXPECT_NEAR(c.all.rms_distance, amplitude / std::sqrt(2), 1e-6);
  EXPECT_NEAR(c.all.rms, amplitude / std::sqrt(6), 1e-6);
  EXPECT_NEAR(c.all.max_distance, amplitude, 0.01 * amplitude);
  EXPECT_NEAR(c.all.velocity_rms, amplitude * std::sin(w / rate_hz) * rate_hz / std::sqrt(6),
              0.005 * amplitude * w);
  ASSERT_TRUE(c.all.bands[0] && c.all.bands[1] && c.all.bands[2] && c.all.bands[3]);
  EXPECT_NEAR(*c.all.bands[1], c.all.rms, 0.06 * c.all.rms);
  EXPECT_LT(*c.all.bands[0], 0.06 * c.all.rms);
  EXPECT_LT(*c.all.bands[2], 0.06 * c.all.rms);
  EXPECT_LT(*c.all.bands[3], 0.01 * c.all.rms);
  EXPECT_LT(*c.all.above_6_hz, 0.06 * c.all.rms);
}

TEST(CompareMarkers, ARigidFitTakesOutATurnAndAShiftOfTheWholeTake) {
  const Quat turn = exp(Vec3{0.3, -1.2, 2.0});
  const Take turned = take_of([&](Vec3 p, std::size_t, std::size_t) {
    return rotate(turn, p) + Vec3{1000, -50, 3};
  });
  EXPECT_GT(compared(turned).all.rms_distance, 500);
  EXPECT_LT(compared(turned, MarkerFit::rigid).all.rms_distance, 1e-9);
  EXPECT_GT(compared(turned, MarkerFit::gain_offset).all.rms_distance, 10);
}

TEST(CompareMarkers, GainsAndOffsetsOfEachChannelAreFitted) {
  const Take scaled = take_of([](Vec3 p, std::size_t, std::size_t m) {
    const double gain = 1.1 + 0.2 * static_cast<double>(m);
    return Vec3{gain * p.x + 30, 0.8 * p.y, p.z - 1e5};
  });
  EXPECT_LT(compared(scaled, MarkerFit::gain_offset).all.rms_distance, 1e-6);
}

// A still take has no error against a reference fitted to it.
TEST(CompareMarkers, TheFitIsThatToTheTakeBeforeCleaningWhereItIsGiven) {
  const Take still = take_of([](Vec3, std::size_t, std::size_t m) { return path(0, m); });
  const Take raw = take_of([](Vec3 p, std::size_t f, std::size_t) {
    return p + Vec3{f % 2 == 0 ? 1.0 : -1.0, 0, 0};
  });
  EXPECT_LT(compared(still, MarkerFit::gain_offset).all.rms, 1e-6);
  MarkerComparisonSettings settings;
  settings.fit = MarkerFit::gain_offset;
  settings.fit_to = &raw;
  EXPECT_GT(compare_markers(reference(), still, settings).all.rms, 50);
}

TEST(CompareMarkers, ALagIsFoundBetweenFramesAndTakenOutWhereItIsGiven) {
  for (const double lag : {-4.0, 3.0, 2.5}) {
    const Take late = take_of(
        [&](Vec3, std::size_t f, std::size_t m) { return path(seconds(f) - lag / rate_hz, m); });
    EXPECT_NEAR(compared(late).lag_s, lag / rate_hz, 1e-4) << lag;
    if (lag != std::round(lag)) continue;
    MarkerComparisonSettings settings;
    settings.lag_frames = static_cast<std::int64_t>(lag);
    const MarkerComparison c = compare_markers(reference(), late, settings);
    EXPECT_EQ(c.frames, frames - static_cast<std::size_t>(std::abs(lag)));
    EXPECT_LT(c.all.rms_distance, 1e-9);
  }
}

TEST(CompareMarkers, SamplesThatOneTakeLacksDoNotCount) {
  Take other = take_of([](Vec3 p, std::size_t, std::size_t m) {
    return m == 1 ? p + Vec3{0, 0, 9} : p;
  });
  for (std::size_t f = 100; f < 200; ++f) {
    other.observed[f * 3 + 1] = 0;
    other.positions[f * 3 + 1] = {1e6, 1e6, 1e6};
  }
  const MarkerComparison c = compared(other);
  EXPECT_EQ(c.markers[1].samples, frames - 100);
  EXPECT_NEAR(c.markers[1].rms_distance, 9, 1e-9);
  EXPECT_NEAR(c.markers[1].velocity_rms, 0, 1e-9);
  EXPECT_NEAR(*c.markers[1].bands[0], 9 / std::sqrt(3), 1e-6);
  for (std::size_t f = 0; f < frames; ++f) other.observed[f * 3 + 1] = 0;
  EXPECT_EQ(compared(other).markers[1].samples, 0U);
}

TEST(CompareMarkers, OnlyChannelsThatMoveCountWhereThatIsAskedFor) {
  // The reference moves by 106 mm (deviation) in z, 212 in x, and 57 in y.
  const Take other = take_of([](Vec3 p, std::size_t, std::size_t) { return p + Vec3{1, 100, 3}; });
  MarkerComparisonSettings settings;
  settings.least_motion = 80;
  EXPECT_NEAR(compare_markers(reference(), other, settings).all.rms, std::sqrt((1 + 9) / 2.0),
              1e-9);
}

TEST(CompareMarkers, NamesAreFoundWithoutTheirSubjectAndUnitsAreBroughtTogether) {
  Take metres = take_of([](Vec3 p, std::size_t, std::size_t) {
    return 0.001 * (p + Vec3{0, 2, 0});
  });
  metres.unit = "m";
  metres.names = {"Ann:C7", "Ann:RASI", "Ann:LWRA"};
  // C7 is the first marker of this take.
  for (std::size_t f = 0; f < frames; ++f)
    std::swap(metres.positions[3 * f], metres.positions[3 * f + 2]);
  Take whole = reference();
  whole.names = {"LASI", "RASI", "C7"};
  const MarkerComparison c = compare_markers(whole, metres);
  EXPECT_EQ(c.names, (std::vector<std::string>{"RASI", "C7"}));
  EXPECT_EQ(c.unmatched, std::vector<std::string>{"LASI"});
  EXPECT_NEAR(c.all.rms_distance, 2, 1e-9);
}

TEST(CompareMarkers, AtLowRatesAndInShortTakesBandsAreNotKnown) {
  Take slow = reference();
  slow.frame_rate_hz = 10;
  const MarkerComparison c = compare_markers(slow, slow);
  EXPECT_TRUE(c.all.bands[0] && c.all.bands[1]);
  EXPECT_FALSE(c.all.bands[2] || c.all.bands[3] || c.all.above_6_hz);
  const Take brief = slice(reference(), 0, 10);
  EXPECT_FALSE(compare_markers(brief, brief).all.bands[0]);
}

TEST(CompareMarkers, TakesThatCannotBeComparedAreRefused) {
  EXPECT_THROW(compared(slice(reference(), 0, 10)), Error);
  Take other = reference();
  other.frame_rate_hz = 50;
  EXPECT_THROW(compared(other), Error);
  other = reference();
  other.names = {"A", "B", "C"};
  EXPECT_THROW(compared(other), Error);
  MarkerComparisonSettings settings;
  settings.lag_frames = frames;
  EXPECT_THROW(compare_markers(reference(), reference(), settings), Error);
  Take fewer = reference();
  fewer.names[0] = "LFHD";
  settings = {};
  settings.fit_to = &fewer;
  EXPECT_THROW(compare_markers(reference(), reference(), settings), Error);
}

}  // namespace
}  // namespace kinemend
