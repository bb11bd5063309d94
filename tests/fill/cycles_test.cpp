#include "fill/cycles.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "kinemend/random.hpp"

namespace kinemend::fill {
namespace {

constexpr CurveSettings settings{.frame_rate_hz = 120};
constexpr std::size_t frames = 700;

// Steps of 1.1 s with a drift, as a marker of a walker moves; in two channels.
double step_motion(std::size_t frame, std::size_t channel) {
  const double phase = 2 * 3.14159265358979 * static_cast<double>(frame) / 132;
  if (channel == 1) return 20 * std::cos(phase) + 6 * std::sin(2 * phase);
  return 30 * std::sin(phase) + 8 * std::sin(2 * phase + 1) + 4 * std::cos(3 * phase) +
         1.3 * static_cast<double>(frame);
}

struct Walk {
  std::vector<double> values;
  std::vector<std::uint8_t> observed;

  explicit Walk(FrameSpan span, double noise = 0) : observed(frames, 1) {
    Random random(1);
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t c = 0; c < 2; ++c) {
        values.push_back(step_motion(f, c) + noise * random.normal());
      }
    }
    for (std::size_t f = span.first; f <= span.last; ++f) {
      observed[f] = 0;
      values[2 * f] = values[2 * f + 1] = 0;
    }
  }
  Track track() { return {values, 2, observed}; }
  double error(FrameSpan span) const {
    double sum = 0;
    for (std::size_t f = span.first; f <= span.last; ++f) {
      sum += std::hypot(values[2 * f] - step_motion(f, 0), values[2 * f + 1] - step_motion(f, 1));
    }
    return sum / static_cast<double>(span.length());
  }
};

TEST(Cycles, AreFoundWholePeriodsAway) {
  const FrameSpan span{300, 380};
  Walk walk(span);
  const auto cycles = find_cycles(walk.track(), span, settings);
  ASSERT_FALSE(cycles.empty());
  for (const Cycle& cycle : cycles) {
    EXPECT_EQ(cycle.lag % 132, 0) << cycle.lag;
    EXPECT_LT(cycle.mismatch, 1e-6);
  }
}

TEST(Cycles, FillAGapThatIsNearlyACycleLong) {
  for (const FrameSpan span :
       {FrameSpan{300, 380}, FrameSpan{250, 370}, FrameSpan{640, 699}, FrameSpan{0, 50}}) {
    Walk walk(span);
    const auto cycles = find_cycles(walk.track(), span, settings);
    ASSERT_TRUE(fill_with_cycles(walk.track(), span, cycles, settings));
    // At the ends of the take nothing holds the drift but the cycle itself.
    EXPECT_LT(walk.error(span), 1e-6) << span.first;
  }
}

TEST(Cycles, BearNoise) {
  const FrameSpan span{300, 380};
  Walk walk(span, 0.5);
  ASSERT_TRUE(
      fill_with_cycles(walk.track(), span, find_cycles(walk.track(), span, settings), settings));
  EXPECT_LT(walk.error(span), 2.5);
  Walk spline(span, 0.5);
  fill_with_curve(spline.track(), span, Curve::quintic, settings);
  EXPECT_GT(spline.error(span), 10);
}

TEST(Cycles, AreNotTakenFromFramesThatAreMissing) {
  const FrameSpan span{300, 380};
  Walk walk(span);
  for (std::size_t f = 400; f < frames; ++f) walk.observed[f] = f % 40 != 0;
  for (const Cycle& cycle : find_cycles(walk.track(), span, settings)) EXPECT_LT(cycle.lag, 0);
}

TEST(Cycles, AreNotFoundInMotionThatDoesNotRepeat) {
  const FrameSpan span{300, 360};
  Walk walk(span);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / 120;
    walk.values[2 * f] = 30 * std::sin(t * t * t);
    walk.values[2 * f + 1] = std::exp(t);
  }
  EXPECT_TRUE(find_cycles(walk.track(), span, settings).empty());
  EXPECT_FALSE(fill_with_cycles(walk.track(), span, {}, settings));
}

TEST(Cycles, AreNotFoundWhereNothingMoves) {
  const FrameSpan span{300, 360};
  Walk walk(span);
  std::fill(walk.values.begin(), walk.values.end(), 5.0);
  EXPECT_TRUE(find_cycles(walk.track(), span, settings).empty());
}

}  // namespace
}  // namespace kinemend::fill
