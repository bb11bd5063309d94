// Tests of the times of noise events, by the statistics of a Poisson process.
#include "lab/damage/track_errors.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace kinemend::corrupt {
namespace {

TEST(NoiseEvents, ComeAtTheRateAskedForWithDurationsInTheirRange) {
  const auto events = uniform_events(30, 0.05, 0.2, 60 * 400, Random(1));
  // 12,000 events have a deviation of 110.
  EXPECT_NEAR(static_cast<double>(events.size()), 12000, 400);
  double mean = 0;
  for (const NoiseEvent event : events) {
    EXPECT_GE(event.duration_s, 0.05);
    EXPECT_LT(event.duration_s, 0.2);
    mean += event.duration_s / static_cast<double>(events.size());
  }
  EXPECT_NEAR(mean, 0.125, 0.003);
}

TEST(NoiseEvents, AreAPoissonProcess) {
  // The counts per minute have equal mean and variance.
  std::vector<double> counts(2000, 0.0);
  for (const NoiseEvent event : uniform_events(20, 0.05, 0.06, 60 * 2000, Random(2)))
    if (event.start_s >= 0) ++counts[static_cast<std::size_t>(event.start_s / 60)];
  double mean = 0, square = 0;
  for (const double count : counts) mean += count / 2000;
  for (const double count : counts) square += (count - mean) * (count - mean) / 2000;
  EXPECT_NEAR(mean, 20, 0.5);
  EXPECT_NEAR(square / mean, 1, 0.12);
}

TEST(NoiseEvents, AreOnAtTheFirstFrameAsOftenAsLater) {
  int at_start = 0, later = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    for (const NoiseEvent event : exponential_events(30, 0.5, 10, Random(seed))) {
      at_start += event.start_s <= 0 ? 1 : 0;
      later += event.start_s <= 5 && event.start_s + event.duration_s > 5 ? 1 : 0;
    }
  }
  // An event is in progress a quarter of the time on average.
  EXPECT_NEAR(at_start, 1000, 120);
  EXPECT_NEAR(later, 1000, 120);
}

TEST(NoiseEvents, DoNotComeWhereNoneAreAskedFor) {
  EXPECT_TRUE(uniform_events(0, 0.05, 0.2, 1000, Random(1)).empty());
  EXPECT_TRUE(exponential_events(0, 0.5, 1000, Random(1)).empty());
}

TEST(NoiseEvents, RiseAndFallOverTheirEdges) {
  const NoiseEvent event{2, 1};
  EXPECT_EQ(event_window(event, 0.1, 1.99), 0);
  EXPECT_NEAR(event_window(event, 0.1, 2.05), 0.5, 1e-12);
  EXPECT_EQ(event_window(event, 0.1, 2.5), 1);
  EXPECT_NEAR(event_window(event, 0.1, 2.95), 0.5, 1e-12);
  EXPECT_EQ(event_window(event, 0.1, 3.01), 0);
  EXPECT_NEAR(event_window(event, 5, 2.25), 0.5, 1e-12) << "edges of half of the event each";
}

}  // namespace
}  // namespace kinemend::corrupt
