// Writes the changes of a glTF file, in its own container or in the other kind.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/gltf/gltf_rewrite.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// The files of a take: the main file, and the separate files that it needs.
struct GltfFiles {
  std::string bytes;
  std::vector<SideFile> beside;
};

/// Returns the file with its changes, binary or as text. A file without changes keeps its bytes if
/// its container is the same. `output`: its path; empty: unknown, so that changed buffers are
/// stored in the text. If the path is known, changed buffers in separate files get the name of the
/// output, and other separate files are copied to its folder if needed.
GltfFiles packed_gltf(const GltfDocument& document, const GltfChanges& changes, bool as_binary,
                      const std::filesystem::path& output);

}  // namespace kinemend
