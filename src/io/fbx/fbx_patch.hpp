// Writes an FBX file with some of its bytes replaced, and the lengths that follow from that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

/// Bytes [begin, end) of the file, which lie within the properties of one record, become `bytes`.
struct FbxPatch {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string bytes;
  /// Binary, of a patch that begins with the list of properties of a record: by how many it grows.
  std::int64_t more_properties = 0;
};

/// The file with the patches, which do not overlap. Ends of records and lengths of lists of
/// properties are written anew where they move, and so is the padding of the footer; every other
/// byte is kept.
std::string write_patched_fbx(const FbxTree& tree, std::vector<FbxPatch> patches);

}  // namespace kinemend
