// Removes numbers that are not finite (nan, inf) from the bytes of a C3D file, so that no output
// written from them contains one. Each function returns how many values or samples it changed.
#pragma once

#include <cstddef>
#include <string>

#include "io/c3d/c3d_layout.hpp"
#include "io/c3d/c3d_parameters.hpp"

namespace kinemend {

/// Gives the reals of POINT and ANALOG that are not finite a neutral value: 1 for the scales of
/// analog channels, 0 for all others, which readers treat as unknown.
std::size_t mend_c3d_parameters(std::string& bytes, C3dProcessor processor,
                                C3dParameters& parameters);

/// Replaces the scale and the rate of the header, which are also in POINT, in the same way.
std::size_t mend_c3d_header(std::string& bytes, C3dProcessor processor, C3dHeader& header,
                            const C3dParameters& parameters);

/// Marks samples of points with a number that is not finite as missing: zeros, and -1.
std::size_t mend_c3d_points(std::string& bytes, C3dProcessor processor, const C3dLayout& layout);

/// Replaces an analog sample that is not finite by the previous sample of its channel, or by 0 at
/// the start.
std::size_t mend_c3d_analog(std::string& bytes, C3dProcessor processor, const C3dLayout& layout);

}  // namespace kinemend
