// Checks and angles that the figures of joints share.
#pragma once

#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::metrics {

/// Errors: `ErrorKind::usage` when the two clips cannot be compared frame by frame and joint by
/// joint.
void check_pair(const Take& reference, const Take& other, std::size_t first_frame);

/// Angle (radians) between the local rotations of every frame from `first_frame` on and joint,
/// frame-major.
std::vector<double> geodesic_angles(const Take& reference, const Take& other,
                                    std::size_t first_frame);

/// Linear interpolation between order statistics, as NumPy's default; `percentile` in [0, 100]. 0
/// for no values.
double percentile_of(std::vector<double> values, double percentile);

}  // namespace kinemend::metrics
