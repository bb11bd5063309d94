// Finds the ankles of a skeleton by the names of its joints.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::feet {

/// Returns the uppermost joint of each foot, of those named after parts of a foot (`foot_joints`).
std::vector<std::size_t> ankles_of(const Skeleton& skeleton);

}  // namespace kinemend::feet
