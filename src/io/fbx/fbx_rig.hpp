// Chooses the models of an FBX file that are joints, and describes how each one moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/fbx/fbx_scene.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// A model that is a joint or an ancestor of one, in tree order.
struct FbxRigNode {
  std::size_t model = 0;
  std::int32_t parent = -1;        ///< node
  std::int32_t joint = -1;         ///< -1: static, part of the frame of the joint below
  std::int32_t parent_joint = -1;  ///< the nearest joint above
  RotationOrder order;             ///< the three rotations of the model, first factor first
  Quat pre, post;                  ///< before and after the rotations; identity unless active
  /// The rotations with curves are [first_turn, end_turn) of the order; the others are constant and
  /// part of the rest rotation (before) or of `tail` (behind).
  std::size_t first_turn = 0, end_turn = 0;
  Quat tail;  ///< from the joint's frame to the model's: constant rotations, then post-rotation
  bool has_translation_curves = false;
};

struct FbxRig {
  std::vector<FbxRigNode> nodes;
  std::vector<std::size_t> joints;  ///< node of each joint, parents first
};

/// The joints are, in tree order:
/// - models of the kinds LimbNode, Limb and Root;
/// - models of any kind above one of these that move, and nulls below one that have curves;
/// - in a file without these, models that have curves (but cameras and lights), and nulls below
///   one.
FbxRig choose_fbx_rig(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                      std::size_t max_depth);

/// Return the rotation order of a model as factors of a product, and the rotation of angles in
/// degrees.
RotationOrder fbx_factors(std::int64_t rotation_order);
Quat fbx_turn(Vec3 degrees, RotationOrder factors);

}  // namespace kinemend
