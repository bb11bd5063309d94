// Finds the floor under the places of ground contact.
#pragma once

#include <vector>

#include "feet/body_points.hpp"

namespace kinemend::feet {

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
