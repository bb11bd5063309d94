// Makes a new C3D file of a take of markers.
#pragma once

#include <string>

#include "io/c3d/c3d_document.hpp"

namespace kinemend {

/// A C3D file of Intel reals. `origin`: the file the clip comes from, if any, whose parameters are
/// kept as far as they still hold, and its analog samples and cameras as far as `C3dCarried` says.
/// Errors: `usage` for names longer than 255 bytes, more than 65,535 markers, and positions too
/// large for a real.
std::string new_c3d(const Take& clip, const C3dOrigin& origin);

}  // namespace kinemend
