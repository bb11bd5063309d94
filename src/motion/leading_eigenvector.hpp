// Finds the leading eigenvector of a small matrix, for means of rotations.
#pragma once

#include <array>

#include "kinemend/rotation.hpp"

namespace kinemend::rotation {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Returns the unit eigenvector of the largest eigenvalue of a symmetric positive semidefinite
/// matrix, up to sign. If the largest eigenvalue is repeated, any vector of its space. `fallback`
/// if the matrix is zero.
Quat leading_eigenvector(Matrix4 matrix, Quat fallback = {});

}  // namespace kinemend::rotation
