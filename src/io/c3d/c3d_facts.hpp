// Describes the content of a C3D file in words.
#pragma once

#include <string>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "io/c3d/c3d_points.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// "DEC integers in steps of 0.1", "Intel reals".
std::string c3d_encoding(const C3dDocument& document);

/// The content of a C3D file beside its points, in words.
std::vector<SourceFact> c3d_facts(const C3dDocument& document, const C3dPointCounts& counts);

}  // namespace kinemend
