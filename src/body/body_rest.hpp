// The rest pose of a skeleton, which way is up, and how tall the body is.
#pragma once

#include <cstdint>
#include <vector>

#include "body/body_names.hpp"
#include "kinemend/take.hpp"

namespace kinemend::representation {

/// A pose that joints' turns are measured from: that of a skeleton whose local rotations are all
/// identity, or, where that is no standing person, the frame of the take that stands straightest.
struct RestPose {
  std::vector<Quat> rotations;  ///< J, global
  std::vector<Quat> unturned;   ///< J, what they would be were the joint's own rotation identity
  std::vector<Vec3> positions;  ///< J, then the end sites
  Quat upright;  ///< turns the file's axes so that the person at rest stands along y and faces z
};
RestPose rest_pose(const Take& clip, const std::vector<BoneName>& bones);

/// Turns the axes of the motion so that y points up. Where it is not clear how the person stands
/// most of the time, or where that is head down, the world is taken to be that of the rest pose.
Quat upright_world(const Take& clip, const std::vector<BoneName>& bones, const RestPose& rest);

/// Body height by the lengths of the legs, whatever the rest pose, else by the longest way along
/// bones from one end to another; 1 for a skeleton without any length.
double body_height_from_legs(const Skeleton& skeleton, const std::vector<BoneName>& bones);

/// The shortest rotation that brings a direction to another; exactly identity where they are the
/// same but for rounding.
Quat shortest_rotation(Vec3 from, Vec3 to);

/// The axis, forward or backward, that a direction is nearest to; y for the zero vector.
Vec3 nearest_axis(Vec3 direction);

/// The joint of that bone and side, the last one of several; -1 when there is none.
std::int32_t find_bone(const std::vector<BoneName>& bones, Bone bone, Side side);

}  // namespace kinemend::representation
