// Tests of the errors of single tracks, by their sizes, spectra and correlations.
#include "lab/damage/track_errors.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "lab/damage/coloured_noise.hpp"
#include "noise_measures.hpp"

namespace kinemend::corrupt {
namespace {

// A family without noise, to which each test adds one kind.
SystemNoise none() {
  SystemNoise noise = system_families()[0].noise;
  noise = scaled(noise, 0);
  noise.arm_factor = noise.depth_factor = 1;
  noise.floor_depth_factor = noise.motion_depth_factor = 1;
  noise.correlation = noise.limb_correlation = 0;
  noise.depth_correlation = noise.depth_limb_correlation = 0;
  noise.bursts_per_min = noise.limb_errors_per_min = 0;
  return noise;
}

struct Channels {
  std::vector<double> x, y, z;
};
Channels channels(const std::vector<Vec3>& errors) {
  Channels result;
  for (const Vec3 e : errors) {
    result.x.push_back(e.x);
    result.y.push_back(e.y);
    result.z.push_back(e.z);
  }
  return result;
}

constexpr std::size_t frames = 60000;
constexpr double rate = 60;
const std::vector<double> still(frames, 0.0);

double deviation(const std::vector<double>& x) { return std::sqrt(test::variance_of(x)); }

TEST(TrackErrors, HaveTheirSizesWithTheirFactors) {
  SystemNoise noise = none();
  noise.std_mm = 5;
  noise.arm_factor = 2;
  noise.depth_factor = 3;
  noise.fc_hz = 2;
  noise.slope = 4;
  TrackErrors errors(noise, frames, rate, Random(1));
  const Channels leg = channels(errors.errors_of({0, 0, false, 2, still, {}}));
  EXPECT_NEAR(deviation(leg.x), 5, 0.2);
  EXPECT_NEAR(deviation(leg.y), 5, 0.2);
  EXPECT_NEAR(deviation(leg.z), 15, 0.6);
  const Channels arm = channels(errors.errors_of({1, 1, true, 0, still, {}}));
  EXPECT_NEAR(deviation(arm.x), 30, 1.2);
  EXPECT_NEAR(deviation(arm.y), 10, 0.4);
}

TEST(TrackErrors, AddTheSpectraOfSlowNoiseAndFloor) {
  SystemNoise noise = none();
  noise.std_mm = 5;
  noise.fc_hz = 1;
  noise.slope = 3;
  noise.floor_mm = 2;
  noise.floor_hz = 20;
  TrackErrors errors(noise, frames, rate, Random(2));
  const Channels of_one = channels(errors.errors_of({0, 0, false, -1, still, {}}));
  const auto found = test::welch(of_one.x, rate, 480);
  for (const auto& [low, high] : {std::pair{1.0, 2.0}, {2, 6}, {6, 15}, {15, 28}}) {
    double expected = 0;
    for (double f = low; f < high; f += 0.01)
      expected += 0.01 * (25 * noise_density({1, 3}, f) + 4 * noise_density({20, 4}, f));
    EXPECT_NEAR(found.between(low, high) / expected, 1, 0.1) << low;
  }
}

TEST(TrackErrors, HaveInCommonWhatTheirBodiesAndLimbsHave) {
  SystemNoise noise = none();
  noise.std_mm = 5;
  noise.floor_mm = 2;
  noise.correlation = 0.2;
  noise.limb_correlation = 0.3;
  noise.depth_correlation = 0.5;
  noise.depth_limb_correlation = 0.5;
  noise.fc_hz = 3;  // a higher corner needs fewer seconds
  TrackErrors errors(noise, frames, rate, Random(3));
  const Channels a = channels(errors.errors_of({0, 0, false, 2, still, {}})),
                 b = channels(errors.errors_of({1, 0, false, 2, still, {}})),
                 c = channels(errors.errors_of({2, 1, false, 2, still, {}}));
  EXPECT_NEAR(test::correlation_of(a.x, b.x), 0.5, 0.04);
  EXPECT_NEAR(test::correlation_of(a.x, c.x), 0.2, 0.05);
  EXPECT_NEAR(test::correlation_of(a.z, b.z), 1, 1e-9);
  EXPECT_NEAR(test::correlation_of(a.z, c.z), 0.5, 0.05);
  EXPECT_NEAR(test::correlation_of(a.x, a.y), 0, 0.05);
}

TEST(TrackErrors, GrowWithSpeed) {
  SystemNoise noise = none();
  noise.floor_mm = 1;
  noise.floor_hz = 20;
  noise.motion_mm = 4;
  noise.motion_hz = 5;
  std::vector<double> speed(frames, 0.0);
  std::fill(speed.begin() + frames / 2, speed.end(), 1.5);
  TrackErrors errors(noise, frames, rate, Random(4));
  const Channels e = channels(errors.errors_of({0, 0, false, -1, speed, {}}));
  const std::vector<double> rest(e.x.begin(), e.x.begin() + frames / 2),
      moving(e.x.begin() + frames / 2, e.x.end());
  // The part of the floor above half of the rate is missing.
  EXPECT_NEAR(deviation(rest), 0.97, 0.04);
  EXPECT_NEAR(deviation(moving), std::hypot(0.97, 6), 0.2);
}

TEST(TrackErrors, HaveBurstsAsOftenAsAskedForAndAsHigh) {
  SystemNoise noise = none();
  noise.floor_mm = 0.001;
  noise.bursts_per_min = 4;
  noise.burst_min_s = noise.burst_max_s = 0.1;
  noise.burst_min_height = 1000;
  noise.burst_max_height = 2000;
  TrackErrors errors(noise, frames, rate, Random(5));
  const Channels e = channels(errors.errors_of({0, 0, false, -1, still, {}}));
  std::size_t bursts = 0;
  double highest = 0;
  for (std::size_t f = 1; f < frames; ++f) {
    bursts += std::abs(e.x[f]) > 0.05 && std::abs(e.x[f - 1]) <= 0.05 ? 1 : 0;
    highest = std::max(highest, std::abs(e.x[f]));
  }
  // The expected number in 1,000 s is 67, with a deviation of 8.
  EXPECT_NEAR(static_cast<double>(bursts), 67, 25);
  EXPECT_NEAR(highest, 2, 0.1);
}

TEST(TrackErrors, OfAWholeLimbAreTheSameForAllOfIt) {
  SystemNoise noise = none();
  noise.limb_error_mm = 30;
  noise.limb_errors_per_min = 30;
  noise.limb_error_s = 0.5;
  noise.depth_factor = 2;
  TrackErrors errors(noise, frames, rate, Random(6));
  const auto a = errors.errors_of({0, 0, false, 2, still, {}}),
             b = errors.errors_of({1, 0, true, 2, still, {}}),
             c = errors.errors_of({2, 1, false, 2, still, {}});
  std::size_t on = 0, both = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    ASSERT_EQ(a[f], b[f]);
    on += a[f] == Vec3{} ? 0 : 1;
    both += a[f] == Vec3{} || c[f] == Vec3{} ? 0 : 1;
  }
  // Expected share of time: a quarter less overlaps, 1 - exp(-1/4); limbs are independent.
  EXPECT_NEAR(static_cast<double>(on) / frames, 0.22, 0.04);
  EXPECT_NEAR(static_cast<double>(both) / frames, 0.05, 0.02);
  const Channels e = channels(a);
  EXPECT_NEAR(deviation(e.z) / deviation(e.x), 2, 0.25);
}

TEST(TrackErrors, LeakDisplacementsToOtherAxesByAFixedShare) {
  SystemNoise noise = none();
  noise.leak = 0.1;
  noise.leak_depth_factor = 3;
  std::vector<Vec3> displacement(200);
  for (std::size_t f = 0; f < 200; ++f) displacement[f].x = static_cast<double>(f);
  const std::vector<double> speed(200, 0.0);
  std::vector<double> depth_shares, image_shares;
  for (std::size_t n = 0; n < 2000; ++n) {
    TrackErrors errors(noise, 200, rate, Random(n));
    const auto e = errors.errors_of({0, 0, false, 2, speed, displacement});
    depth_shares.push_back(e[100].z / 100);
    image_shares.push_back(e[100].y / 100);
    ASSERT_EQ(e[100].x, 0);
    ASSERT_NEAR(e[150].y, 1.5 * e[100].y, 1e-9);
  }
  EXPECT_NEAR(deviation(image_shares), 0.1, 0.007);
  EXPECT_NEAR(deviation(depth_shares), 0.3, 0.02);
}

TEST(TrackErrors, OfATrackDoNotDependOnWhichOthersAreAskedFor) {
  const SystemNoise noise = system_families()[0].noise;
  TrackErrors some(noise, 200, rate, Random(7)), other(noise, 200, rate, Random(7));
  const std::vector<double> speed(200, 1.0);
  some.errors_of({4, 2, false, 0, speed, {}});
  some.errors_of({5, 1, true, 0, speed, {}});
  EXPECT_EQ(some.errors_of({9, 2, true, 1, speed, {}}),
            other.errors_of({9, 2, true, 1, speed, {}}));
}

}  // namespace
}  // namespace kinemend::corrupt
