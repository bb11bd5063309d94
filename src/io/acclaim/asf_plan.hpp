// Plans the bones that an ASF file needs for a skeleton.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/acclaim/asf.hpp"
#include "kinemend/skeleton.hpp"

namespace kinemend {

/// A bone that stands for a joint, or that leads from one to a child beside its end.
struct PlannedBone {
  std::string name;
  std::int32_t parent = -1;  ///< index of a bone; -1 for the root
  std::int32_t joint = -1;   ///< -1 where it only leads to a child
  Quat axis;                 ///< its frame at rest, in the world
  Vec3 extent;               ///< from its beginning to its end, at rest, in the world
  std::vector<AsfDof> dofs;
};

/// The bones of a skeleton as ASF has them, where a child begins at its parent's end: bone 0 is the
/// root, parents stand before their children. A joint becomes a bone of its name that ends where
/// all its children are; where they are apart, it has no length, and a bone without degrees of
/// freedom leads to each. Names that the format cannot hold are altered, and stay different from
/// each other. Errors: `usage` when the format cannot hold the skeleton.
std::vector<PlannedBone> plan_bones(const Skeleton& skeleton);

/// ASF gives the root all three positions: the missing channels come first.
Skeleton with_root_positions(Skeleton skeleton);

}  // namespace kinemend
