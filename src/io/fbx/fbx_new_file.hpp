// Writes a take as a new FBX file.
#pragma once

#include <string>

#include "kinemend/take.hpp"

namespace kinemend {

/// Returns a binary file of version 7.5: limbs or nulls, one animation of one layer, a key per
/// frame. Errors: `usage` for an invalid take.
std::string new_fbx_file(const Take& take);

}  // namespace kinemend
