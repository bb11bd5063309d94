// Writes new values or new keys into the record of an animation curve.
#pragma once

#include <cstdint>
#include <vector>

#include "io/fbx/fbx_curve.hpp"
#include "io/fbx/fbx_patch.hpp"
#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

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
