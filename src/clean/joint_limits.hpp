#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "kinemend/body.hpp"
#include "kinemend/model.hpp"
#include "kinemend/pose_matrix.hpp"
#include "kinemend/skeleton.hpp"

// What joints can do, as a projection of poses in the channels of a body.
namespace kinemend {

/// Limits of a joint's Euler angles in the order of its file.
struct EulerLimits {
  std::size_t part = 0;                  ///< of the layout
  std::string name;                      ///< of the joint in the take
  RotationOrder order;                   ///< with one or two axes: the joint turns about these only
  std::array<ChannelLimit, 3> angles{};  ///< degrees
  /// With the part's channels v the joint's local rotation is before Exp(v) after.
  Quat before, after;
};

struct JointLimits {
  std::vector<ChannelLimit> channels;  ///< D, degrees; empty: none
  std::vector<EulerLimits> joints;     ///< of parts that differ

  bool empty() const noexcept { return channels.empty() && joints.empty(); }
};

/// The range of each channel in training: the model's tensor `limits`, D x 2. None where the model
/// has no such tensor. Errors: `ErrorKind::unreadable_input` for another shape or a range that is
/// none.
JointLimits learned_joint_limits(const Model& model);

/// What the take's skeleton file states (ASF), of joints below the root.
JointLimits skeleton_joint_limits(const Skeleton& skeleton, const BodyLayout& layout,
                                  const BodyMatch& match);

/// Limits of skeleton files are often no more than a guess, and a take may do what training takes
/// did not. Where these poses of the take are beyond a limit in more than 1 % of the frames on that
/// side, it moves out to what 99 % keep to; a joint with an Euler limit that would move by more
/// than 20 degrees has none. Returns the joints with Euler limits that the take breaks and by how
/// much, in words.
std::vector<std::string> widen_joint_limits(JointLimits& limits, const PoseMatrix& poses);

/// `nearest` becomes `poses` with every channel clamped to its range, then every Euler angle (of
/// the branch that breaks the limits least). Poses within the limits stay the same to the bit.
void project_to_limits(const JointLimits& limits, const PoseMatrix& poses, PoseMatrix& nearest);

}  // namespace kinemend
