// Smooths a point, finds its standing level, marks the frames in which it touches, and fits a plane
// to places of contact, with small weights for outliers.
#include "feet/floor.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/frame_span.hpp"
#include "base/quantiles.hpp"

namespace kinemend::feet {

namespace {

// Returns the mean over the frames around each frame in which the point is seen.
std::vector<Vec3> smoothed(const BodyPoints& body, std::size_t point, double reach_s) {
  const std::size_t reach = frames_in(reach_s, body.frame_rate_hz, 0);
  std::vector<Vec3> result(body.frames);
  for (std::size_t f = 0; f < body.frames; ++f) {
    // The window is symmetric, so that a straight path is unchanged.
    const std::size_t around = std::min({reach, f, body.frames - 1 - f});
    double count = 0;
    for (std::size_t k = f - around; k <= f + around; ++k) {
      if (!body.is_observed(k, point)) continue;
      result[f] += body.at(k, point);
      ++count;
    }
    if (count > 0) result[f] = (1 / count) * result[f];
  }
  return result;
}

double standing_level(const SolePoint& point, double body_height, double slow) {
  // The quantile of heights that represents the lowest, and the body heights above it within which
  // a part may stand. Chosen by hand, not swept.
  constexpr double low = 0.02, near_low = 0.06;
  std::vector<double> heights;
  for (std::size_t f = 0; f < point.heights.size(); ++f) {
    if (point.seen[f] != 0) heights.push_back(point.heights[f]);
  }
  const double lowest = quantile_of(heights, low);
  heights.clear();
  for (std::size_t f = 0; f < point.heights.size(); ++f) {
    const bool stands = point.seen[f] != 0 && point.speeds[f] < slow * body_height &&
                        point.heights[f] < lowest + near_low * body_height;
    if (stands) heights.push_back(point.heights[f]);
  }
  return heights.empty() ? lowest : median_of(heights);
}

}  // namespace

SolePoint sole_point(const BodyPoints& body, std::size_t index, Up up,
                     const ContactThresholds& thresholds, double reach_s) {
  SolePoint point;
  point.path = smoothed(body, index, reach_s);
  const std::vector<Vec3>& path = point.path;
  for (std::size_t f = 0; f < body.frames; ++f) {
    const std::size_t before = f == 0 ? 0 : f - 1;
    const Vec3 velocity = body.frame_rate_hz * (path[f] - path[before]);
    const Vec3 level = level_part(velocity, up);
    point.heights.push_back(along(path[f], up));
    point.velocities.push_back(level);
    point.speeds.push_back(norm(velocity));
    point.seen.push_back(body.is_observed(f, index) && body.is_observed(before, index) ? 1 : 0);
  }
  point.level = standing_level(point, body.height, thresholds.begin_speed);
  return point;
}

std::vector<std::uint8_t> touches(const SolePoint& point, const std::vector<double>& levels,
                                  double body_height, const ContactThresholds& thresholds) {
  return touches(point, levels, point.speeds, body_height, thresholds);
}

std::vector<std::uint8_t> touches(const SolePoint& point, const std::vector<double>& levels,
                                  const std::vector<double>& speeds, double body_height,
                                  const ContactThresholds& thresholds) {
  std::vector<std::uint8_t> result(point.heights.size());
  bool down = false;
  for (std::size_t f = 0; f < result.size(); ++f) {
    const double height = point.heights[f] - (levels.size() == 1 ? levels[0] : levels[f]);
    down = point.seen[f] != 0 &&
           height < (down ? thresholds.keep_height : thresholds.begin_height) * body_height &&
           speeds[f] < (down ? thresholds.keep_speed : thresholds.begin_speed) * body_height;
    result[f] = down;
  }
  return result;
}

namespace {

// Returns the two coordinates other than height.
std::pair<double, double> across(Vec3 v, Up up) {
  if (up.axis == Axis::x) return {v.y, v.z};
  if (up.axis == Axis::y) return {v.x, v.z};
  return {v.x, v.y};
}

// The height of the plane a + b u + c v, by weighted least squares through the places.
struct Plane {
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();

  double height_at(Vec3 place, Up up) const {
    const auto [u, v] = across(place, up);
    return coefficients.dot(Eigen::Vector3d(1, u, v));
  }
};

Plane fit(const std::vector<Vec3>& places, const std::vector<double>& weights, Up up,
          double metre) {
  // Regularises towards level ground, which is negligible once the places cover a metre.
  Eigen::Matrix3d normal =
      Eigen::Vector3d(0, 0.1 * metre * metre, 0.1 * metre * metre).asDiagonal();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [u, v] = across(places[i], up);
    middle += weights[i] * Eigen::Vector2d(u, v);
    sum += weights[i];
  }
  middle /= sum;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [u, v] = across(places[i], up);
    const Eigen::Vector3d row(1, u - middle.x(), v - middle.y());
    normal += weights[i] * row * row.transpose();
    right += weights[i] * along(places[i], up) * row;
  }
  Eigen::Vector3d solution = normal.ldlt().solve(right);
  solution[0] -= solution[1] * middle.x() + solution[2] * middle.y();
  return {solution};
}

}  // namespace

std::vector<double> depths_below_floor(const std::vector<Vec3>& places, Up up, double close_to,
                                       double metre) {
  // The share of the places that must be close to a floor, and the rounds of reweighting. Chosen by
  // hand, not swept.
  constexpr double most_share = 2.0 / 3;
  constexpr int rounds = 20;
  std::vector<double> depths(places.size()), weights(places.size(), 1);
  for (int round = 0; round < rounds && !places.empty(); ++round) {
    const Plane floor = fit(places, weights, up, metre);
    for (std::size_t i = 0; i < places.size(); ++i) {
      depths[i] = floor.height_at(places[i], up) - along(places[i], up);
      // Cauchy's weights, which are small for outliers.
      weights[i] = 1 / (1 + depths[i] * depths[i] / (close_to * close_to));
    }
  }
  const auto close = std::count_if(depths.begin(), depths.end(),
                                   [&](double depth) { return std::fabs(depth) < close_to; });
  if (static_cast<double>(close) < most_share * static_cast<double>(places.size())) return {};
  return depths;
}

double floor_height(const BodyPoints& body, Up up) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Foot& foot : body.feet) {
    for (const std::size_t point : foot.points)
      lowest = std::min(lowest, sole_point(body, point, up).level);
  }
  return lowest;
}

}  // namespace kinemend::feet
