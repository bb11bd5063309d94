// Tests of cycles, on a motion of known period.
#include "fill/cycles.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend::fill {
namespace {

constexpr CurveSettings cycle_settings{.frame_rate_hz = 120};
constexpr std::size_t frames = 700;

// Steps of 1.1 s with a drift, as a marker of a walker moves.
Vec3 step_motion(std::size_t frame) {
  const double phase = 2 * pi * static_cast<double>(frame) / 132;
  return {30 * std::sin(phase) + 8 * std::sin(2 * phase + 1) + 4 * std::cos(3 * phase) +
              1.3 * static_cast<double>(frame),
          20 * std::cos(phase) + 6 * std::sin(2 * phase), 0};
}

Track walk_without(FrameSpan span, double noise = 0) {
  Random random(1);
  Track track{{}, std::vector<std::uint8_t>(frames, 1)};
  for (std::size_t f = 0; f < frames; ++f) {
    const double x = noise * random.normal(), y = noise * random.normal();
    track.values.push_back(step_motion(f) + Vec3{x, y, 0});
  }
  for (std::size_t f = span.first; f <= span.last; ++f) track.observed[f] = 0, track.values[f] = {};
  return track;
}

double error_of(const Track& track, FrameSpan span) {
  double sum = 0;
  for (std::size_t f = span.first; f <= span.last; ++f)
    sum += norm(track.values[f] - step_motion(f));
  return sum / static_cast<double>(span.length());
}

TEST(Cycles, AreFoundWholePeriodsAway) {
  const FrameSpan span{300, 380};
  Track walk = walk_without(span);
  const auto cycles = find_cycles(walk, span, cycle_settings);
  ASSERT_FALSE(cycles.empty());
  for (const Cycle& cycle : cycles) {
    EXPECT_EQ(cycle.lag % 132, 0) << cycle.lag;
    EXPECT_LT(cycle.mismatch, 1e-6);
  }
}

TEST(Cycles, FillAGapThatIsNearlyACycleLong) {
  for (const FrameSpan span :
       {FrameSpan{300, 380}, FrameSpan{250, 370}, FrameSpan{640, 699}, FrameSpan{0, 50}}) {
    Track walk = walk_without(span);
    ASSERT_TRUE(fill_by_cycles(walk, span, cycle_settings, 1));
    // At the ends of the take, only the cycle itself determines the drift.
    EXPECT_LT(error_of(walk, span), 1e-6) << span.first;
  }
}

TEST(Cycles, BearNoise) {
  const FrameSpan span{300, 380};
  Track walk = walk_without(span, 0.5);
  ASSERT_TRUE(fill_by_cycles(walk, span, cycle_settings, 1));
  EXPECT_LT(error_of(walk, span), 2.5);
  Track spline = walk_without(span, 0.5);
  fill_with_curve(spline, span, Curve::quintic, cycle_settings);
  EXPECT_GT(error_of(spline, span), 10);
}

TEST(Cycles, AreNotTakenFromFramesThatAreMissing) {
  const FrameSpan span{300, 380};
  Track walk = walk_without(span);
  for (std::size_t f = 400; f < frames; ++f) walk.observed[f] = f % 40 != 0;
  const auto cycles = find_cycles(walk, span, cycle_settings);
  EXPECT_FALSE(cycles.empty());
  for (const Cycle& cycle : cycles) EXPECT_LT(cycle.lag, 0);
}

TEST(Cycles, AreNotFoundInMotionThatDoesNotRepeat) {
  const FrameSpan span{300, 360};
  Track walk = walk_without(span);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / 120;
    walk.values[f] = {30 * std::sin(t * t * t), std::exp(t), 0};
  }
  EXPECT_TRUE(find_cycles(walk, span, cycle_settings).empty());
  EXPECT_FALSE(fill_by_cycles(walk, span, cycle_settings, 1));
}

TEST(Cycles, AreNotFoundWhereNothingMoves) {
  const FrameSpan span{300, 360};
  Track walk = walk_without(span);
  std::fill(walk.values.begin(), walk.values.end(), Vec3{5, 5, 5});
  EXPECT_TRUE(find_cycles(walk, span, cycle_settings).empty());
}

}  // namespace
}  // namespace kinemend::fill
