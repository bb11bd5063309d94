// One point of a foot over time, and when it is low and slow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "feet/body_points.hpp"

namespace kinemend::feet {

/// One point of a foot, smoothed so that jitter does not count as travel.
struct SolePoint {
  std::vector<Vec3> path;
  std::vector<double> heights;
  std::vector<Vec3> velocities;  ///< horizontal, a second; of the step that ends in the frame
  std::vector<double> speeds;    ///< in all directions, a second
  std::vector<std::uint8_t> seen;
  double level = 0;  ///< its usual height when standing
};

/// Thresholds of low (body heights above a level) and slow (body heights a second): those to begin
/// a contact are tighter than those to continue it (hysteresis). Chosen by hand (docs/feet.md), not
/// swept.
struct ContactThresholds {
  double begin_height = 0.015, keep_height = 0.03;
  double begin_speed = 0.15, keep_speed = 0.25;
};

/// Averages over `reach_s` on either side.
SolePoint sole_point(const BodyPoints& body, std::size_t index, Up up,
                     const ContactThresholds& thresholds, double reach_s);

/// F, 1 where the point is low above `levels` (F; one for all frames where it has one entry) and
/// slow.
std::vector<std::uint8_t> touches(const SolePoint& point, const std::vector<double>& levels,
                                  double body_height, const ContactThresholds& thresholds);
/// The same with other speeds than its own.
std::vector<std::uint8_t> touches(const SolePoint& point, const std::vector<double>& levels,
                                  const std::vector<double>& speeds, double body_height,
                                  const ContactThresholds& thresholds);

}  // namespace kinemend::feet
