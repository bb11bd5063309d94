// Calibrates joint frames by the motion itself: the channels of one motion are the same on every
// rig.
#pragma once

#include <vector>

#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/pose_matrix.hpp"

namespace kinemend {

/// A rig's bone axes and rest pose turn the frame of each joint by a constant rotation. Let G_j be
/// the rotation of joint j in the body's frame, the product of the rotations q along its ancestors,
/// and M_j the same product of the layout's references. With the turns
///
///   K_j = mean(G_j)^-1 M_j,    q'_j = K_p^-1 q_j K_j    (p the parent; the root has no K_p)
///
/// every joint has the reference as its mean pose, and q' no longer depends on such constants: on
/// another rig G_j is G_j A_j, mean(G_j) is mean(G_j) A_j, and G_j K_j is unchanged.
struct BodyCalibration {
  std::vector<Quat> turns;  ///< N: K
};

/// `poses`: F x D channels of the layout's joints, degrees; at least one frame. The mean is that of
/// quaternions, each with the sign that is nearer to the sum so far.
BodyCalibration calibration_of(const PoseMatrix& poses, const BodyLayout& layout);
/// Converts the channels of q to those of q'; channels of the place are unchanged. `rate_hz` is the
/// frame rate.
PoseMatrix calibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                      const BodyCalibration& calibration);
/// Converts the channels of q' to those of q.
PoseMatrix uncalibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                        const BodyCalibration& calibration);

}  // namespace kinemend
