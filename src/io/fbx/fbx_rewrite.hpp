// Writes a changed take into the FBX file that it comes from.
#pragma once

#include <string>

#include "io/fbx/fbx_document.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Whether the take has the joints, or the markers, of the document.
bool fits_fbx_document(const Take& take, const FbxDocument& document, const Take& original);

/// The file with other keys in the curves of what changed; `original` is `take_of_fbx(document)`.
/// Changes that no curve can hold are left out: translations and turns about axes without a curve.
/// Errors: `usage` for a curve that moves several things, and for a joint that layers move.
std::string rewrite_fbx(const Take& take, const FbxDocument& document, const Take& original);

}  // namespace kinemend
