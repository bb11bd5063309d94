// Fits a plane to the places, with small weights for outliers.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "feet/floor.hpp"
#include "feet/sole_point.hpp"

namespace kinemend::feet {

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
  constexpr double reach_s = 0.02;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Foot& foot : body.feet) {
    for (const std::size_t point : foot.points)
      lowest = std::min(lowest, sole_point(body, point, up, ContactThresholds{}, reach_s).level);
  }
  return lowest;
}

}  // namespace kinemend::feet
