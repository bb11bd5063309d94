// Describes the rotations of a joint as vectors that linear filters can work on.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend {

/// Rotations of one joint as vectors in radians, without a singularity however far the joint turns:
/// the increments Log(b[t]^-1 b[t+1]) of a reference b sum to a path in R^3, and a rotation q[t] is
/// the path's point plus the offset Log(b[t]^-1 q[t]). White noise on a rotation is the same noise
/// on its vector as long as the offsets are small.
struct RotationChart {
  std::vector<Quat> reference;  ///< b, F
  std::vector<Vec3> path;       ///< F

  Vec3 vector_of(std::size_t frame, Quat rotation) const {
    return path[frame] + log(conjugate(reference[frame]) * rotation);
  }
  Quat rotation_of(std::size_t frame, Vec3 vector) const {
    return normalized(reference[frame] * exp(vector - path[frame]));
  }
};

}  // namespace kinemend
