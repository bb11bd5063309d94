// Makes binary glTF files of takes that were not read from glTF.
#pragma once

#include <string>

#include "kinemend/take.hpp"

namespace kinemend {

/// As `write_glb` describes a new file. The clip is valid.
std::string new_glb_of_joints(const Take& clip);
/// As `write_glb_markers` does.
std::string new_glb_of_markers(const Take& clip);

}  // namespace kinemend
