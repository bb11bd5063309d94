// The components of a vector by the number of an axis.
#pragma once

#include <cstddef>

#include "kinemend/rotation.hpp"

namespace kinemend {

/// x, y or z of a vector: axis 0, 1 or 2.
inline double component(Vec3 v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
inline double& component_of(Vec3& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace kinemend
