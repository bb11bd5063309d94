// Computes bases for short windows of motion: cosines over time (DCT), and the leading eigenvectors
// of large symmetric matrices.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
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

struct LeadingEigenvectors {
  std::size_t size = 0;         ///< n
  std::vector<double> values;   ///< k, descending
  std::vector<double> vectors;  ///< n x k, row-major: one vector per column, orthonormal
};

struct EigenvectorLimits {
  double energy = 0.99;      ///< the fewest that sum to this share of the trace
  std::size_t count = 0;     ///< number instead; 0: by energy
  double tolerance = 1e-11;  ///< |A v - value v| relative to the largest eigenvalue
};

/// The eigenvectors with the largest eigenvalues of a positive semidefinite matrix, n x n and
/// symmetric, by Spectra's implicitly restarted Lanczos, or by Eigen's full solver for a large
/// share of them. The signs make the entry of largest size positive. Eigenvalues that are 0 to
/// rounding are not returned.
LeadingEigenvectors leading_eigenvectors(std::span<const double> matrix, std::size_t n,
                                         const EigenvectorLimits& limits = {});

}  // namespace kinemend
