// Writes new values or new keys into the record of an animation curve.
#pragma once

#include <cstdint>
#include <vector>

#include "io/fbx/fbx_curve.hpp"
#include "io/fbx/fbx_patch.hpp"
#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

/// Adds the patches that give the keys of a curve these values, one a key. A value that rounds to
/// the float of the file keeps its bytes. Where a value changes on a curve whose tangents the file
/// states, the tangents become straight lines from key to key. True when anything changes.
bool patch_fbx_values(const FbxTree& tree, const FbxCurve& curve, const std::vector<double>& values,
                      std::vector<FbxPatch>& patches);

/// Adds the patches that give a curve other keys, straight from one to the next.
void bake_fbx_curve(const FbxTree& tree, const FbxCurve& curve,
                    const std::vector<std::int64_t>& times, const std::vector<double>& values,
                    std::vector<FbxPatch>& patches);

/// The patch that gives a property which is an integer another value.
FbxPatch fbx_integer_patch(const FbxTree& tree, const FbxProperty& property, std::int64_t value);

}  // namespace kinemend
