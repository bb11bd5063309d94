// Finds the leading eigenvectors of large symmetric matrices.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace kinemend {

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
