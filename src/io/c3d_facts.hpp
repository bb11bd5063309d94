#pragma once

#include <vector>

#include "io/c3d_document.hpp"
#include "io/c3d_points.hpp"
#include "kinemend/clip.hpp"

namespace kinemend {

/// What a C3D file holds beside its points, in words.
std::vector<SourceFact> c3d_facts(const C3dDocument& document, const C3dPointCounts& counts);

}  // namespace kinemend
