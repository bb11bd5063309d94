// Cuts takes into overlapping windows and transforms a window over time by cosines (DCT).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinemend {

/// The temporal DCT of a window of N frames, scaled so that coefficients do not depend on the rate:
/// x_i = sum_k c_k phi_k(i) with phi_0 = 1 and phi_k(i) = sqrt(2) cos(pi k (i + 1/2) / N), and
/// c_k = 1/N sum_i x_i phi_k(i). Coefficient k is of frequency k / (2 window_s). White noise of
/// variance v is white noise of variance v / N in the coefficients.
/// N x `count`, count <= N.
Eigen::MatrixXd window_cosines(Eigen::Index frames, Eigen::Index count);

/// Frames of a window of `window_s`: 4 at least.
Eigen::Index window_frames(double window_s, double rate_hz);

/// First frames of windows that cover `frames` frames, every quarter of a window, the last one
/// flush with the end; 0 alone for a take that is no longer than a window.
std::vector<Eigen::Index> window_starts(Eigen::Index frames, Eigen::Index window);

}  // namespace kinemend
