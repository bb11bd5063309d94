// Tests of leave-one-out predictions and of the choice of smoothers.
#include "signal/leave_one_out.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend::signal {
namespace {

constexpr double rate_hz = 120;

// Eight tracks of curves with noise; one track drifts far.
LaneBlock noisy_lanes(std::size_t frames, std::uint64_t seed) {
  LaneBlock block(frames);
  Random random(seed);
  for (std::size_t t = 0; t < frames; ++t) {
    const double s = static_cast<double>(t) / rate_hz;
    for (std::size_t i = 0; i < lane_row; ++i) {
      const double lane = static_cast<double>(i % lane_tracks);
      const double curve = 20 * std::sin((1 + lane) * s + lane) + (lane == 3 ? 90 * s : 0);
      block.row(t)[i] = curve + (0.2 + lane) * random.normal();
    }
  }
  return block;
}

// Solves one axis of one track as a single channel.
std::vector<double> whole_fit(const LaneBlock& y, std::size_t axis_and_lane, double cutoff_hz) {
  ChannelBlock channel(y.frames), x(y.frames);
  for (std::size_t t = 0; t < y.frames; ++t) channel(t, 0) = y.row(t)[axis_and_lane];
  const double strength = strength_of_cutoff(std::min(cutoff_hz / rate_hz, 0.49), 2);
  solve_shared(factor_shared(y.frames, 2, strength), channel, x);
  std::vector<double> fit;
  for (std::size_t t = 0; t < y.frames; ++t) fit.push_back(x(t, 0));
  return fit;
}

double cutoff_of(std::size_t smoother) {
  return 0.3 * std::pow(100.0, static_cast<double>(smoother) / 9);
}

// The lengths cover one tile, several tiles, and a last tile of one frame.
TEST(LeaveOneOut, FitsInTilesAsTheWholeIsFitted) {
  for (const std::size_t frames : {6, 300, 2048, 2049, 9000}) {
    const LaneBlock y = noisy_lanes(frames, frames);
    const LeaveOneOut others(frames, rate_hz);
    ASSERT_EQ(others.smoothers(), 10U);
    for (const std::size_t smoother : {0, 4, 9}) {
      std::vector<double> fit(frames * lane_row);
      std::size_t next = 0;
      others.fit(smoother, y, [&](std::size_t first, std::size_t count, const double* x) {
        ASSERT_EQ(first, next);
        std::copy(x, x + count * lane_row,
                  fit.begin() + static_cast<std::ptrdiff_t>(first * lane_row));
        next = first + count;
      });
      ASSERT_EQ(next, frames);
      for (const std::size_t column : {0, 3, 12, 23}) {
        const std::vector<double> expected = whole_fit(y, column, cutoff_of(smoother));
        double largest = 0;
        for (std::size_t t = 0; t < frames; ++t)
          largest = std::max(largest, std::fabs(fit[t * lane_row + column] - expected[t]));
        EXPECT_LT(largest, 1e-9) << frames << " frames, smoother " << smoother << ", " << column;
      }
    }
  }
}

TEST(LeaveOneOut, ChoosesWhatPredictsBest) {
  const std::size_t frames = 700;
  const LaneBlock y = noisy_lanes(frames, 2);
  const LeaveOneOut others(frames, rate_hz);
  BlockRow caps;
  for (std::size_t i = 0; i < lane_tracks; ++i) caps[i] = 4 + static_cast<double>(i);
  const auto best = others.best_smoothers(y, caps);
  for (std::size_t i = 0; i < lane_tracks; ++i) {
    std::vector<double> sums(others.smoothers());
    for (std::size_t m = 0; m < others.smoothers(); ++m) {
      std::vector<double> axes[3];
      for (std::size_t a = 0; a < 3; ++a) axes[a] = whole_fit(y, a * lane_tracks + i, cutoff_of(m));
      for (std::size_t t = 0; t < frames; ++t) {
        double square = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          const double error =
              (y.row(t)[a * lane_tracks + i] - axes[a][t]) / others.weights_of_others(m)[t];
          square += error * error;
        }
        sums[m] += std::min(square, caps[i]);
      }
    }
    EXPECT_EQ(best[i],
              static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin()))
        << "track " << i;
  }
}

TEST(LeaveOneOut, HasNoSmoothersForTakesOfThreeFrames) {
  EXPECT_EQ(LeaveOneOut(3, rate_hz).smoothers(), 0U);
  EXPECT_EQ(LeaveOneOut(0, rate_hz).smoothers(), 0U);
}

}  // namespace
}  // namespace kinemend::signal
