// Takes the matrix of a node apart.
#pragma once

#include <span>

#include "kinemend/rotation.hpp"

namespace kinemend {

struct GltfPlacement {
  Vec3 translation;
  Quat rotation;
  Vec3 scale{1, 1, 1};      ///< all negative for a matrix that mirrors
  bool is_sheared = false;  ///< the product of the parts is another matrix
};

/// Of 16 numbers, column by column.
GltfPlacement placement_of_matrix(std::span<const double> matrix);

/// The nearest rotation of a quaternion as written; identity for a zero one.
Quat unit_rotation(Quat q);

/// The product by components.
inline Vec3 scaled(Vec3 scale, Vec3 v) { return {scale.x * v.x, scale.y * v.y, scale.z * v.z}; }

}  // namespace kinemend
