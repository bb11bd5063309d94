// Smooths a point, finds its standing level, and marks the frames in which it touches.
#include "feet/sole_point.hpp"

#include <algorithm>
#include <cmath>

#include "base/quantiles.hpp"

namespace kinemend::feet {

namespace {

// Returns the mean over the frames around each frame in which the point is seen.
std::vector<Vec3> smoothed(const BodyPoints& body, std::size_t point, double reach_s) {
  const auto reach = static_cast<std::size_t>(std::lround(reach_s * body.frame_rate_hz));
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

}  // namespace kinemend::feet
