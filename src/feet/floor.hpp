// Finds the floor under the places where feet stand.
#pragma once

#include <vector>

#include "feet/body_points.hpp"

namespace kinemend::feet {

/// How deep each place where a foot stands is below the floor; negative above it. The floor is the
/// plane (level where the places are few) that most of them lie on, so that a tilted calibration is
/// not attributed to a foot. Empty where less than two thirds of them lie within `close` of it:
/// stairs, climbing. `metre`: in the unit of the places.
std::vector<double> depths_below_floor(const std::vector<Vec3>& places, Up up, double close,
                                       double metre);

/// The height of the lowest level on which a point of a foot stands as a rule. The body has feet
/// and frames.
double floor_height(const BodyPoints& body, Up up);

}  // namespace kinemend::feet
