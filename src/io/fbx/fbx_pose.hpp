// Computes where the joints of an FBX file are at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/fbx/fbx_rig.hpp"
#include "io/fbx/fbx_scene.hpp"

namespace kinemend {

/// Frames that one thread evaluates at least: enough that its own poser costs next to nothing.
inline constexpr std::size_t fbx_frames_a_range = 512;

/// A 3 x 3 matrix by rows.
struct FbxMatrix {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
};

/// A node at a time.
struct FbxNodePose {
  std::array<Vec3, 3> local;  ///< by `FbxVector`
  Quat turn;                  ///< of the model in the world, without scales
  Quat joint_turn;            ///< of the joint's frame in the world
  FbxMatrix linear;           ///< of the model in the world, with scales
  FbxMatrix unscaled;         ///< without the model's own scale
  Vec3 centre;                ///< of rotation, in the world: the joint's position
};

/// Evaluates the nodes of a rig at successive times.
class FbxPoser {
 public:
  FbxPoser(const FbxScene& scene, const FbxMotion& motion, const FbxRig& rig);

  /// The pose of every node, valid until the next call.
  const std::vector<FbxNodePose>& at(std::int64_t time);
  /// One vector of one node at each of `times`, which ascend. Far quicker than whole poses.
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

/// Takes a step of a node's translation to one of its position, in the frame of the joint above.
FbxMatrix fbx_step_matrix(const FbxRig& rig, const std::vector<FbxNodePose>& poses,
                          const FbxRigNode& node);

FbxMatrix operator*(const FbxMatrix& a, const FbxMatrix& b);
Vec3 operator*(const FbxMatrix& a, Vec3 v);
FbxMatrix fbx_matrix(Quat rotation);
/// False where the matrix has no usable inverse.
bool invert_fbx_matrix(const FbxMatrix& matrix, FbxMatrix& inverse);

}  // namespace kinemend
