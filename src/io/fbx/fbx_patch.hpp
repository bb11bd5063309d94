// Writes an FBX file with some of its bytes replaced, such as the keys of an animation curve, and
// updates the lengths that depend on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/fbx/fbx_curve.hpp"
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

/// Adds the patches that give the keys of a curve these values, one per key. A value that rounds to
/// the float of the file keeps its bytes. If a value changes on a curve whose tangents the file
/// states, the tangents become straight lines from key to key. Returns whether anything changes.
bool patch_fbx_values(const FbxTree& tree, const FbxCurve& curve, const std::vector<double>& values,
                      std::vector<FbxPatch>& patches);

/// Adds the patches that give a curve new keys with linear interpolation.
void bake_fbx_curve(const FbxTree& tree, const FbxCurve& curve,
                    const std::vector<std::int64_t>& times, const std::vector<double>& values,
                    std::vector<FbxPatch>& patches);

/// Returns the patch that changes the value of an integer property.
FbxPatch fbx_integer_patch(const FbxTree& tree, const FbxProperty& property, std::int64_t value);

}  // namespace kinemend
