// Tests of joining the network's result with measured smoothing.
#include "methods/learned/motion_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>

namespace kinemend {
namespace {

using Change = std::function<double(double)>;  // correction of each axis, by frame

// One track that turns slowly; `measured` and the result subtract the given change.
MotionTake take_with(const Change& measured) {
  MotionTake take;
  take.frames = 600;
  take.channels = 3;
  take.frame_rate_hz = 120;
  take.is_position.assign(3, 0);
  take.slots.assign(3, -1);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const auto t = static_cast<double>(f);
    for (int axis = 0; axis < 3; ++axis) {
      take.values.push_back(static_cast<float>(10 * std::sin(0.02 * t)));
      take.measured.push_back(take.values.back() - static_cast<float>(measured(t)));
    }
  }
  return take;
}

MotionResult result_of(const MotionTake& take, const Change& taken_out) {
  MotionResult result{take.values, {}};
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] -= static_cast<float>(taken_out(static_cast<double>(i / 3)));
  return result;
}

// The share of the distance to `measured` that the result moved, where both differ.
double share_gone(const MotionTake& take, const MotionResult& before, const MotionResult& after) {
  double gone = 0, way = 0;
  for (std::size_t i = 0; i < before.values.size(); ++i) {
    const auto whole = static_cast<double>(take.measured[i] - before.values[i]);
    gone += whole * static_cast<double>(after.values[i] - before.values[i]);
    way += whole * whole;
  }
  return gone / way;
}

// Changes sign every 5 frames, a 25th of a second.
double quick(double t) { return std::fmod(t, 10) < 5 ? 1 : -1; }

TEST(JoinMeasured, TakesTheMeanWhereBothTakeOutAsMuchQuickNoise) {
  const MotionTake take = take_with(quick);
  const MotionResult before = result_of(take, [](double t) { return -quick(t); });
  MotionResult after = before;
  join_measured(take, after);
  EXPECT_NEAR(share_gone(take, before, after), 0.5, 1e-5);
}

TEST(JoinMeasured, GoesAsFarAsTheShareOfMeasuredInWhatBothTakeOut) {
  const MotionTake take = take_with([](double t) { return 3 * quick(t); });
  const MotionResult before = result_of(take, quick);
  MotionResult after = before;
  join_measured(take, after);
  EXPECT_NEAR(share_gone(take, before, after), 0.9, 1e-5);
}

TEST(JoinMeasured, TrustsTheNetworkAboutSlowNoise) {
  const MotionTake take = take_with([](double t) { return 2 * std::sin(0.01 * t); });
  const MotionResult before = result_of(take, [](double) { return 0; });
  MotionResult after = before;
  join_measured(take, after);
  EXPECT_LT(share_gone(take, before, after), 1e-4);
}

TEST(JoinMeasured, LeavesTracksInWhichNothingWasMeasured) {
  const MotionTake take = take_with([](double) { return 0; });
  const MotionResult before = result_of(take, quick);
  MotionResult after = before;
  join_measured(take, after);
  EXPECT_EQ(after.values, before.values);
}

TEST(JoinMeasured, CountsNoSamplesThatAreMissing) {
  MotionTake take = take_with(quick);
  take.missing.assign(take.values.size(), 0);
  const MotionResult before = result_of(take, [](double t) { return -quick(t); });
  for (std::size_t i = 0; i < 150; ++i) {
    take.missing[i] = 1;
    take.measured[i] += 1000;
  }
  MotionResult after = before;
  join_measured(take, after);
  const std::size_t seen = 3 * 300;
  EXPECT_NEAR(after.values[seen], take.values[seen], 1e-4);
}

}  // namespace
}  // namespace kinemend
