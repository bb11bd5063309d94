// Writes an FBX file with some of its bytes replaced, and updates the lengths that depend on them.
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
  /// Binary files: how many properties are added by a patch that begins with the property list of a
  /// record.
  std::int64_t more_properties = 0;
};

/// Returns the file with the patches, which must not overlap. Ends of records, lengths of property
/// lists and the padding of the footer are updated where they move; every other byte is kept.
std::string write_patched_fbx(const FbxTree& tree, std::vector<FbxPatch> patches);

}  // namespace kinemend
