// Puts the changes of a glTF file into bytes, in its own container or in the other one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/gltf/gltf_rewrite.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// The files of a take: its own, and those that it needs beside it.
struct GltfFiles {
  std::string bytes;
  std::vector<SideFile> beside;
};

/// The file with its changes, binary or as text. A file without changes keeps its bytes where its
/// container stays. `output`: where it will stand; empty: nobody knows, so that changed buffers go
/// into the text. With a place, changed buffers that stood beside the source get the name of the
/// output, and what is needed beside it in another folder is copied there.
GltfFiles packed_gltf(const GltfDocument& document, const GltfChanges& changes, bool as_binary,
                      const std::filesystem::path& output);

}  // namespace kinemend
