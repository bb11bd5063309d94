// Makes binary glTF files from takes that were not read from glTF.
#pragma once

#include <string>

#include "kinemend/take.hpp"

namespace kinemend {

/// Returns a new file as described at `write_glb`. The clip must be valid.
std::string new_glb_of_joints(const Take& clip);
std::string new_glb_of_markers(const Take& clip);

}  // namespace kinemend
