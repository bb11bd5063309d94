// Continues rotation vectors and the signs of quaternions from frame to frame.
#pragma once

#include "kinemend/rotation.hpp"

namespace kinemend {

/// Channels in the tangent space are too distorted to be filtered beyond this angle from a joint's
/// mean (150 degrees).
inline constexpr double tangent_limit_rad = 150 * radians_per_degree;

/// Returns the rotation vector v (1 + 2 pi k / |v|) that is nearest to `previous`; all of them are
/// the same rotation.
Vec3 continue_rotation_vector(Vec3 v, Vec3 previous);

/// Continues the sign of a quaternion from frame to frame, unaffected by noise and jumps: a few
/// outlier frames (more than 60 degrees) do not flip the sign of the motion after them.
class SignContinuation {
 public:
  /// Returns `q` or `-q`. The first quaternion keeps its sign.
  Quat next(Quat q);

 private:
  Quat previous_, steady_;
  int frames_away_ = -1;  // -1: no frame yet
};

}  // namespace kinemend
