// Reads the keys of animation curves from their records.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "io/fbx/fbx_curve.hpp"
#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

/// Returns the places of the values among the properties of a `Key` of version 6. Errors: as in
/// reading.
std::vector<std::uint32_t> fbx_value_places(const FbxTree& tree, const FbxRecord& keys);

/// Reads curves of one file. Curves with the same packed key times share them.
class FbxKeyReader {
 public:
  explicit FbxKeyReader(const FbxTree& tree) : tree_(tree) {}

  /// Reads the curve of an `AnimationCurve` (version 7), or of a `Channel` with keys (version 6). A
  /// curve without keys has no values. Errors: `unreadable_input` for key times that do not ascend,
  /// counts that disagree, an unknown letter, or more keys than the file's bytes can hold.
  FbxCurve read(std::uint32_t record);
  /// Reads a curve in two steps. `begin` reads the key times, which show whether the curve has
  /// keys. `finish`, which may run for several curves in parallel, fills in values and shapes.
  FbxCurve begin(std::uint32_t record);
  void finish(FbxCurve& curve) const;

 private:
  void begin_arrays(std::uint32_t record, FbxCurve& curve);
  void read_letters(const FbxRecord& keys, std::int64_t count, FbxCurve& curve) const;
  void read_shapes(FbxCurve& curve) const;
  std::shared_ptr<const std::vector<std::int64_t>> times_of(const FbxRecord& record);
  void check_times(const FbxRecord& record, const std::vector<std::int64_t>& times) const;
  void count_keys(const FbxRecord& record, std::size_t keys);

  const FbxTree& tree_;
  std::string_view last_times_;
  std::shared_ptr<const std::vector<std::int64_t>> shared_times_;
  std::size_t keys_ = 0;
};

}  // namespace kinemend
