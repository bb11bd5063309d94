#pragma once

#include <string>

#include "io/c3d_document.hpp"

namespace kinemend {

/// A C3D file of Intel reals. `source`: unless null, the file the clip comes from, whose parameters
/// are kept as far as they still hold; its analog samples and cameras too, where the clip has its
/// frames and markers. Errors: `usage` for names longer than 255 bytes, more than 65,535 markers,
/// and positions too large for a real.
std::string new_c3d(const MarkerClip& clip, const C3dDocument* source);

}  // namespace kinemend
