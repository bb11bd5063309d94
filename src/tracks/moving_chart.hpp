#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend {

/// Rotations of one joint as vectors in radians, with no singularity however far the joint turns: a
/// smooth reference moves with the joint, its increments Log(b[t]^-1 b[t+1]) add up to a path in
/// R^3, and a rotation is that path's point plus its own small offset Log(b[t]^-1 q[t]). Smoothing
/// the vectors smooths the rotations; noise on a rotation is the same noise on its vector.
struct MovingChart {
  std::vector<Quat> reference;  ///< b, F
  std::vector<Vec3> path;       ///< F, path[0] = 0

  Vec3 vector_of(std::size_t frame, Quat rotation) const {
    return path[frame] + log(conjugate(reference[frame]) * rotation);
  }
  Quat rotation_of(std::size_t frame, Vec3 vector) const {
    return normalized(reference[frame] * exp(vector - path[frame]));
  }
};

/// A chart about the Gaussian mean (standard deviation `width_s`, cut at 2.5 of them and at the
/// ends of the take) of a track without gross spikes. The signs of the quaternions do not matter.
MovingChart make_moving_chart(std::span<const Quat> track, double frame_rate_hz,
                              double width_s = 0.05);

}  // namespace kinemend
