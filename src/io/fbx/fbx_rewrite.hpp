// Writes a changed take into its source FBX file.
#pragma once

#include <string>

#include "io/fbx/fbx_document.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Whether the take has the joints, or the markers, of the document.
bool fits_fbx_document(const Take& take, const FbxDocument& document, const Take& original);

/// Returns the file with new keys in the curves of changed joints; `original` is
/// `take_of_fbx(document)`. Changes that no curve can hold are left out: translations and rotations
/// of axes without a curve. Errors: `usage` for a curve that moves several axes or models, and for
/// a joint that several layers move.
std::string rewrite_fbx(const Take& take, const FbxDocument& document, const Take& original);

}  // namespace kinemend
