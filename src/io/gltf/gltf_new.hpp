// Makes binary glTF files of takes that were not read from glTF.
#pragma once

#include <string>

#include "kinemend/clip.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// As `write_glb` describes a new file. The clip is valid.
std::string new_glb_of_joints(const Clip& clip);
/// As `write_glb_markers` does.
std::string new_glb_of_markers(const MarkerClip& clip);

}  // namespace kinemend
