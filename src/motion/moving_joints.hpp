// Finds the joints that turn at all within a take.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Whether a joint has two rotations that differ at all, observed or not.
bool joint_moves(const Take& clip, std::size_t joint);
/// Returns all joints that move, in the skeleton's order.
std::vector<std::size_t> moving_joints(const Take& clip);

}  // namespace kinemend
