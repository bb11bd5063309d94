// The format glTF: writes takes as animated scenes.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/take.hpp"

namespace kinemend {

/// 100 for a binary glTF file, which is written, not read.
int sniff_glb(std::string_view head);
/// A clip as an animated skeleton with a skinned mesh of its bones, in metres (`metres_per_unit`, a
/// guess by the skeleton's height, or 1), axes as they are. Errors: `usage` for an invalid clip.
std::string write_glb(const Take& clip);
/// Markers as small spheres that move, in metres (millimetres where the clip names no known unit);
/// a missing one shrinks to nothing. Errors: the same.
std::string write_glb_markers(const Take& clip);

}  // namespace kinemend
