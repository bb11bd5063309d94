// Computes the global positions and rotations of joints (forward kinematics).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Global rotations and positions of one frame: J of each, in file units.
/// R_j = R_parent rest_j q_j and p_j = p_parent + R_parent offset_j, roots in the world frame.
struct Pose {
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;
};

Pose forward_kinematics(const Take& clip, std::size_t frame);

/// Returns joint positions of every frame, F x J, or F x (J + E) with end sites, in file units.
std::vector<Vec3> joint_positions(const Take& clip, bool with_end_sites = false);

}  // namespace kinemend
