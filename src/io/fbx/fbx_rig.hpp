// Chooses the models of an FBX file that are joints, describes how each one moves, and computes
// their poses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/fbx/fbx_scene.hpp"
#include "kinemend/extend/rotation.hpp"

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

/// The least number of frames for a thread, so that the cost of its own poser is negligible.
inline constexpr std::size_t fbx_frames_a_range = 512;

/// A 3 x 3 matrix by rows.
struct FbxMatrix {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
};

/// The pose of a node at one time.
struct FbxNodePose {
  std::array<Vec3, 3> local;  ///< by `FbxVector`
  Quat turn;                  ///< global rotation of the model, without scales
  Quat joint_turn;            ///< global rotation of the joint's frame
  FbxMatrix linear;           ///< global transform of the model, with scales
  FbxMatrix unscaled;         ///< `linear` without the model's own scale
  Vec3 centre;                ///< global centre of rotation: the joint's position
};

/// Evaluates the nodes of a rig at successive times.
class FbxPoser {
 public:
  FbxPoser(const FbxScene& scene, const FbxMotion& motion, const FbxRig& rig);

  /// The pose of every node, valid until the next call.
  const std::vector<FbxNodePose>& at(std::int64_t time);
  /// Evaluates one vector of one node at each of `times`, which must ascend. Much faster than whole
  /// poses.
  void locals_over(std::size_t node, FbxVector vector, std::span<const std::int64_t> times,
                   std::span<Vec3> out);

 private:
  void evaluate(std::size_t node, FbxVector vector, std::int64_t time);
  void place(std::size_t node);
  Vec3 layer_value(const FbxAnimatedVector& animated, std::int64_t time);

  const FbxScene& scene_;
  const FbxMotion& motion_;
  const FbxRig& rig_;
  std::vector<std::array<std::vector<const FbxAnimatedVector*>, 3>> animated_;  // by node
  std::vector<std::size_t> cursors_;                                            // by curve
  std::vector<bool> is_animated_;                                               // 3 * node + vector
  std::vector<FbxNodePose> poses_;
};

/// Returns the matrix that converts a step of a node's translation to a step of its position, in
/// the frame of the joint above.
FbxMatrix fbx_step_matrix(const FbxRig& rig, const std::vector<FbxNodePose>& poses,
                          const FbxRigNode& node);

FbxMatrix operator*(const FbxMatrix& a, const FbxMatrix& b);
Vec3 operator*(const FbxMatrix& a, Vec3 v);
FbxMatrix fbx_matrix(Quat rotation);
/// Returns false if the matrix has no usable inverse.
bool invert_fbx_matrix(const FbxMatrix& matrix, FbxMatrix& inverse);

}  // namespace kinemend
