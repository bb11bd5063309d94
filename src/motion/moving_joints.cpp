// Compares the rotations of a joint with its first rotation.
#include "motion/moving_joints.hpp"

namespace kinemend {

bool joint_moves(const Take& clip, std::size_t joint) {
  for (std::size_t f = 1; f < clip.frame_count(); ++f) {
    if (clip.rotation(f, joint) != clip.rotation(0, joint)) return true;
  }
  return false;
}

std::vector<std::size_t> moving_joints(const Take& clip) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (joint_moves(clip, j)) joints.push_back(j);
  }
  return joints;
}

}  // namespace kinemend
