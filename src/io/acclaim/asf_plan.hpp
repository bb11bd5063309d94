// Plans the bones that an ASF file needs for a skeleton.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/acclaim/asf.hpp"
#include "kinemend/skeleton.hpp"

namespace kinemend {

/// A bone for a joint, or a connecting bone from a joint to a child that is not at its end.
struct PlannedBone {
  std::string name;
  std::int32_t parent = -1;  ///< index of a bone; -1 for the root
  std::int32_t joint = -1;   ///< -1 for a connecting bone
  Quat axis;                 ///< its frame at rest, in the world
  Vec3 extent;               ///< from its beginning to its end, at rest, in the world
  std::vector<AsfDof> dofs;
};

/// Returns the bones of a skeleton for ASF, in which a child begins at its parent's end. Bone 0 is
/// the root, and parents precede their children. A joint becomes a bone of its name that ends where
/// all its children are. If the children are apart, the bone has no length, and a bone without
/// degrees of freedom leads to each child. Names that the format cannot hold are changed and stay
/// different from each other. Errors: `usage` if the format cannot hold the skeleton.
std::vector<PlannedBone> plan_bones(const Skeleton& skeleton);

/// Adds the missing position channels of the root at the front, because ASF gives the root all
/// three.
Skeleton with_root_positions(Skeleton skeleton);

}  // namespace kinemend
