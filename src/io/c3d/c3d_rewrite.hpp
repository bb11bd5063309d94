// Writes a changed take into the bytes of the C3D file that it comes from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/c3d/c3d_document.hpp"

namespace kinemend {

bool same_c3d_events(const std::vector<MarkerEvent>& a, const std::vector<MarkerEvent>& b);

/// Whether the clip differs from its document in samples and rate only.
bool keeps_c3d_layout(const Take& clip, const C3dDocument& document);

/// The document's own bytes with every changed sample replaced, for a clip that keeps its layout.
/// Nothing where a sample does not fit into the document's integers.
std::optional<std::string> rewrite_c3d(const Take& clip, const C3dDocument& document);

}  // namespace kinemend
