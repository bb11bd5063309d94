// Turns a changed take into changes of its source file.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "io/gltf/gltf_json.hpp"
#include "io/gltf/gltf_motion.hpp"

namespace kinemend {

/// The changes of a file: pieces of its JSON text, and the whole content of some buffers.
struct GltfChanges {
  std::vector<JsonEdit> edits;
  std::map<std::size_t, std::string> buffers;
};

/// Returns the smallest changes that make the file hold the take, which has the document's joints
/// or markers. Values are replaced in place. A track gets new keys at the end of a buffer if it
/// does not have a key in each frame, shares its bytes with other data, or cannot hold a value.
/// Errors: `usage` for a joint that cannot be moved.
GltfChanges changes_of_gltf(const Take& take, const GltfDocument& document,
                            const GltfMotion& motion);

}  // namespace kinemend
