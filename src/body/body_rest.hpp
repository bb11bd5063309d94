// The rest pose of a skeleton, its up direction, and the body height.
#pragma once

#include <vector>

#include "body/body_names.hpp"
#include "kinemend/take.hpp"

namespace kinemend::representation {

/// The pose relative to which joints turn: the pose of a skeleton with identity local rotations,
/// or, if that is not a standing person, the straightest frame of the take.
struct RestPose {
  std::vector<Quat> rotations;  ///< J, global
  std::vector<Quat> unturned;   ///< J, the same with the joint's own rotation set to identity
  std::vector<Vec3> positions;  ///< J, then the end sites
  Quat upright;  ///< turns the file's axes so that the person at rest stands along y and faces z
};
RestPose rest_pose(const Take& clip, const std::vector<BoneName>& bones);

/// Returns the rotation that turns the motion's axes so that y points up. If the person's usual
/// posture is unclear or head down, the world is taken to be that of the rest pose.
Quat upright_world(const Take& clip, const std::vector<BoneName>& bones, const RestPose& rest);

/// Returns the body height from the lengths of the legs, whatever the rest pose, else from the
/// longest path along bones between two ends; 1 for a skeleton without lengths.
double body_height_from_legs(const Skeleton& skeleton, const std::vector<BoneName>& bones);

/// Returns the shortest rotation from one direction to another; exactly identity if they are equal
/// up to rounding.
Quat shortest_rotation(Vec3 from, Vec3 to);

/// Returns the positive or negative axis nearest to a direction; y for the zero vector.
Vec3 nearest_axis(Vec3 direction);

}  // namespace kinemend::representation
