// Tests of the slow trend of tracks: at curves, ends, spikes and gaps.
#include "body/body_trend.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::representation {
namespace {

std::vector<double> ones(std::size_t count) { return std::vector<double>(count, 1.0); }

// The definition: the value of a weighted least squares polynomial around each frame, by
// Gauss-Jordan elimination.
double polynomial_at(const std::vector<double>& track, double deviation, std::size_t frame,
                     std::size_t degree) {
  const std::size_t n = degree + 1;
  std::vector<std::vector<double>> a(n, std::vector<double>(n + 1));
  for (std::size_t g = 0; g < track.size(); ++g) {
    const double k = (static_cast<double>(g) - static_cast<double>(frame)) / deviation;
    if (std::fabs(k) * deviation > std::ceil(3 * deviation)) continue;
    const double w = std::exp(-0.5 * k * k);
    for (std::size_t r = 0; r < n; ++r) {
      for (std::size_t c = 0; c < n; ++c) a[r][c] += w * std::pow(k, static_cast<double>(r + c));
      a[r][n] += w * std::pow(k, static_cast<double>(r)) * track[g];
    }
  }
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t r = 0; r < n; ++r) {
      if (r == p) continue;
      const double factor = a[r][p] / a[p][p];
      for (std::size_t c = p; c <= n; ++c) a[r][c] -= factor * a[p][c];
    }
  }
  return a[0][n] / a[0][0];
}

TEST(SmoothTrend, IsAParabolaAroundEachFrameAndALineAtTheEnds) {
  // The track is monotone, so the median changes nothing.
  std::vector<double> track;
  for (int f = 0; f < 400; ++f) track.push_back(f * 0.1 + 5 * std::sin(f * 0.016));
  for (const double rate : {20.0, 100.0}) {
    const double deviation = 0.5 * rate;
    const auto trend = smooth_trend(track, ones(400), rate, 0.5);
    for (std::size_t f = 80; f < 320; ++f)
      EXPECT_NEAR(trend[f], polynomial_at(track, deviation, f, 2), 1e-3) << rate << " " << f;
    for (const std::size_t f : {0, 399})
      EXPECT_NEAR(trend[f], polynomial_at(track, deviation, f, 1), 1e-3) << rate << " " << f;
  }
}

TEST(SmoothTrend, HardlyCutsCurves) {
  // A walk of 1.3 m/s on a circle of 1 m radius.
  std::vector<Vec3> path;
  for (int f = 0; f < 600; ++f) path.push_back({std::cos(1.3 * f / 60), 0, std::sin(1.3 * f / 60)});
  const auto trend = smooth_path(path, ones(600), 60, 0.5);
  for (std::size_t f = 60; f < 540; ++f) EXPECT_NEAR(norm(trend[f]), 1, 0.03) << f;
}

TEST(SmoothTrend, KeepsStraightLinesToTheEnds) {
  for (const std::size_t frames : {1, 2, 3, 7, 50, 333}) {
    std::vector<double> line;
    for (std::size_t f = 0; f < frames; ++f) line.push_back(5 - 0.3 * static_cast<double>(f));
    const auto trend = smooth_trend(line, ones(frames), 120, 0.5);
    for (std::size_t f = 0; f < frames; ++f) EXPECT_NEAR(trend[f], line[f], 1e-9) << frames;
  }
  EXPECT_TRUE(smooth_trend({}, {}, 120, 0.5).empty());
}

TEST(SmoothTrend, DoesNotSeeSpikes) {
  std::vector<double> line;
  for (int f = 0; f < 200; ++f) line.push_back(0.1 * f);
  std::vector<double> spiked = line;
  for (const std::size_t f : {0, 20, 21, 90, 199}) spiked[f] += 1000;
  const auto trend = smooth_trend(spiked, ones(200), 30, 0.5);
  for (std::size_t f = 0; f < 200; ++f) EXPECT_NEAR(trend[f], line[f], 0.15) << f;
}

TEST(SmoothPath, DoesNotSeeHowAxesAreTurned) {
  std::vector<Vec3> path, turned;
  const Quat turn = exp({0, 0.7, 0});
  Random random(4);
  for (int f = 0; f < 300; ++f) {
    path.push_back({std::sin(0.05 * f) + 0.01 * random.normal(), 3.0 * f, 0.02 * f});
    if (f % 50 == 9) path.back().x += 100;
    turned.push_back(rotate(turn, path.back()));
  }
  const auto trend = smooth_path(path, ones(300), 60, 0.5);
  const auto turned_trend = smooth_path(turned, ones(300), 60, 0.5);
  for (std::size_t f = 0; f < 300; ++f) {
    EXPECT_EQ(trend[f].y, 0);
    EXPECT_LT(std::fabs(trend[f].x), 1.2);
    EXPECT_LT(norm(rotate(turn, trend[f]) - turned_trend[f]), 1e-9) << f;
  }
}

TEST(SmoothTrend, BridgesWhatIsNotKnown) {
  std::vector<double> line, weights;
  for (int f = 0; f < 300; ++f) {
    const bool known = f > 10 && f < 280 && (f < 100 || f >= 200);
    line.push_back(known ? 0.1 * f : 1e6);
    weights.push_back(known ? 1 : 0);
  }
  const auto trend = smooth_trend(line, weights, 30, 0.5);
  for (std::size_t f = 12; f < 275; ++f)
    EXPECT_NEAR(trend[f], 0.1 * static_cast<double>(f), 0.05) << f;
  for (const double value : smooth_trend(line, std::vector<double>(300), 30, 0.5))
    EXPECT_EQ(value, 0);
}

TEST(SmoothTrend, AveragesNoise) {
  Random random(2);
  std::vector<double> noise;
  for (int f = 0; f < 2000; ++f) noise.push_back(random.normal());
  const auto trend = smooth_trend(noise, ones(2000), 30, 0.5);
  double sum = 0;
  for (std::size_t f = 100; f < 1900; ++f) sum += trend[f] * trend[f];
  // A Gaussian of 15 frames leaves 1 / sqrt(2 sqrt(pi) 15) = 0.137 of white noise; the parabola
  // leaves sqrt(27 / 16) times as much, and the median of five frames before it is less efficient.
  EXPECT_NEAR(std::sqrt(sum / 1800), 0.2, 0.04);
}

TEST(ContinueAngles, PassesWholeTurnsAndIsNotTurnedBySpikes) {
  std::vector<double> angles, expected;
  for (int f = 0; f < 100; ++f) {
    expected.push_back(0.2 * f);
    angles.push_back(wrap_angle(0.2 * f, pi));
  }
  angles[40] = wrap_angle(angles[40] + 3.1, pi);
  std::vector<double> weights(100, 1.0);
  weights[60] = 0;
  angles[60] = 55;
  continue_angles(angles, weights);
  for (std::size_t f = 0; f < 100; ++f) {
    if (f == 40 || f == 60) continue;
    EXPECT_NEAR(angles[f], expected[f], 1e-9) << f;
  }
}

}  // namespace
}  // namespace kinemend::representation
