// Computes the poses of the joints of an FBX file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/fbx/fbx_rig.hpp"
#include "io/fbx/fbx_scene.hpp"

namespace kinemend {

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
