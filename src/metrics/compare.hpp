// Provides the checks and angles that all figures of two takes share.
#pragma once

#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::metrics {

/// Throws `ErrorKind::usage` if the two clips cannot be compared frame by frame and joint by joint.
void check_pair(const Take& reference, const Take& other, std::size_t first_frame);

/// Returns the angles (radians) between the local rotations of each joint, for every frame from
/// `first_frame` on, frame-major.
std::vector<double> geodesic_angles(const Take& reference, const Take& other,
                                    std::size_t first_frame);

/// Returns the percentile by linear interpolation between order statistics, as NumPy does by
/// default; `percentile` is in [0, 100]. Returns 0 for no values.
double percentile_of(std::vector<double> values, double percentile);

}  // namespace kinemend::metrics
