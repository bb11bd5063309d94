// The local coordinates of Xiao et al. 2015, section 3.1.1.
#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// The points that define a pose's frame; -1: the body has none. Without a root, poses stay in the
/// frame of the body; without one of the others they are only translated.
struct LocalPoints {
  std::int32_t root = -1;
  std::int32_t left_hip = -1, right_hip = -1, neck = -1;
};

/// x_local = turn (x - origin)
struct LocalFrame {
  Quat turn;
  Vec3 origin;
};

/// The frame of each pose of `positions` (F x 3 P): the root at the origin, the plane of the hips
/// and the neck parallel to XY, the ray from between the hips to the neck along +Y, the left hip at
/// +X. If the three are nearly on a line or a point, the frame is turned as in the last pose in
/// which they are not (before the first such pose, as in that one).
std::vector<LocalFrame> local_frames(const PoseMatrix& positions, const LocalPoints& points);

/// Convert to local coordinates and back, exactly.
void to_local(const std::vector<LocalFrame>& frames, PoseMatrix& positions);
void from_local(const std::vector<LocalFrame>& frames, PoseMatrix& positions);

}  // namespace kinemend
