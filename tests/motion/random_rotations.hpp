// Draws random vectors and rotations.
#pragma once

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::test {

/// Each coordinate is normal with the given deviation.
inline Vec3 random_vector(Random& random, double deviation = 1) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {deviation * x, deviation * y, deviation * z};
}

/// A uniformly distributed rotation.
inline Quat random_rotation(Random& random) {
  const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  return normalized({w, x, y, z});
}

}  // namespace kinemend::test
