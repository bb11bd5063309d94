// Points of feet over time, the frames in which they touch the floor, and the floor under the
// places of contact.
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
  std::vector<Vec3> velocities;  ///< horizontal, per second, of the step that ends in the frame
  std::vector<double> speeds;    ///< in all directions, per second
  std::vector<std::uint8_t> seen;
  double level = 0;  ///< its usual height in ground contact
};

/// Thresholds of low (body heights above a level) and slow (body heights a second). Hysteresis:
/// a contact begins at tighter thresholds than it continues. Chosen by hand (docs/feet.md), not
/// swept.
struct ContactThresholds {
  double begin_height = 0.015, keep_height = 0.03;
  double begin_speed = 0.15, keep_speed = 0.25;
};

/// The reach of the means over a point, on either side, where noise does not ask for more. Chosen
/// by hand, not swept.
inline constexpr double usual_reach_s = 0.02;

/// Smooths the point by means over `reach_s` on either side.
SolePoint sole_point(const BodyPoints& body, std::size_t index, Up up,
                     const ContactThresholds& thresholds = {}, double reach_s = usual_reach_s);

/// Returns F values, 1 where the point is slow and low above `levels` (F; a single entry is used
/// for all frames).
std::vector<std::uint8_t> touches(const SolePoint& point, const std::vector<double>& levels,
                                  double body_height, const ContactThresholds& thresholds);
/// Does the same with the given speeds.
std::vector<std::uint8_t> touches(const SolePoint& point, const std::vector<double>& levels,
                                  const std::vector<double>& speeds, double body_height,
                                  const ContactThresholds& thresholds);

/// Returns the depth of each place of ground contact below the floor; negative above it. The floor
/// is the plane (level if there are few places) on which most of them lie, so that a tilted
/// calibration is not attributed to a foot. Empty if less than two thirds of them lie within
/// `close` of it, as on stairs or in climbing. `metre`: in the unit of the places.
std::vector<double> depths_below_floor(const std::vector<Vec3>& places, Up up, double close,
                                       double metre);

/// Returns the height of the lowest level on which a point of a foot usually stands. The body must
/// have feet and frames.
double floor_height(const BodyPoints& body, Up up);

}  // namespace kinemend::feet
