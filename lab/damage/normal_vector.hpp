// Draws vectors of independent normal numbers.
#pragma once

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::corrupt {

/// Returns three independent standard normal numbers: x, then y, then z.
inline Vec3 normal_vector(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

}  // namespace kinemend::corrupt
