// Decomposes the matrix of a node.
#pragma once

#include <cmath>
#include <span>

#include "kinemend/rotation.hpp"

namespace kinemend {

struct GltfPlacement {
  Vec3 translation;
  Quat rotation;
  Vec3 scale{1, 1, 1};      ///< all negative if the matrix mirrors
  bool is_sheared = false;  ///< the product of the parts differs from the matrix
};

/// Decomposes 16 numbers, column by column.
GltfPlacement placement_of_matrix(std::span<const double> matrix);

/// Returns the nearest rotation of a quaternion as written; identity for zero.
Quat unit_rotation_of_any(Quat q);
inline Quat unit_rotation(Quat q) {
  const double square = dot(q, q);
  // Within these limits the square neither overflows nor loses digits.
  if (square > 1e-3 && square < 1e3) return (1 / std::sqrt(square)) * q;
  return unit_rotation_of_any(q);
}

/// Returns the product by components.
inline Vec3 scaled(Vec3 scale, Vec3 v) { return {scale.x * v.x, scale.y * v.y, scale.z * v.z}; }

}  // namespace kinemend
