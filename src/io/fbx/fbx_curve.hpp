// Holds the curve of one animated number, keys and the interpolation between them, and reads it
// from its record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

/// Larger values are damage, not positions or angles.
inline constexpr double largest_fbx_value = 1e30;
/// About 578 days; far below the overflow of sums of times.
inline constexpr std::int64_t largest_fbx_time = std::int64_t{1} << 61;

/// The interpolation from a key to the next one.
struct FbxKeyShape {
  enum Kind : std::uint8_t { constant, constant_next, linear, cubic, cubic_auto, cubic_tcb };
  Kind kind = linear;
  bool is_time_independent = false;  ///< for `cubic_auto`: neighbours have equal weight
  bool is_clamped = false;           ///< for `cubic_auto`: no overshoot
  /// For `cubic`: value units per second at this key and at the next. For `cubic_tcb`: tension,
  /// continuity.
  float right_slope = 0, next_left_slope = 0;
  float bias = 0;                                ///< for `cubic_tcb`
  float right_weight = 0, next_left_weight = 0;  ///< share of the step; 0 if not weighted
};

/// The extrapolation of a curve before its first key or after its last.
struct FbxExtrapolation {
  /// C holds the key, K continues with its slope, R repeats, A repeats from the last value, M
  /// mirrors.
  char type = 'C';
  std::int64_t repetitions = -1;  ///< negative: unlimited
};

struct FbxCurve {
  std::uint32_t record = 0;
  std::shared_ptr<const std::vector<std::int64_t>> times;  ///< ticks, ascending
  std::vector<double> values;       ///< one per key, at least one; NaN if not finite
  std::vector<FbxKeyShape> shapes;  ///< one, or one per key
  FbxExtrapolation before, after;

  std::size_t key_count() const { return values.size(); }
  const FbxKeyShape& shape(std::size_t key) const { return shapes[shapes.size() == 1 ? 0 : key]; }
  /// Whether the curve always has the same value.
  bool is_constant() const;
};

/// Returns the value at any time; see `fbx_value_at`.
double fbx_value_anywhere(const FbxCurve& curve, std::int64_t time, double ticks_per_second,
                          std::size_t& cursor);

/// Returns the value at a time. `cursor`: 0 at first, then the value left by the last call; it
/// makes successive times fast. `ticks_per_second`: of the file.
inline double fbx_value_at(const FbxCurve& curve, std::int64_t time, double ticks_per_second,
                           std::size_t& cursor) {
  // Usually the next key is requested.
  const std::size_t next = cursor + 1;
  const std::vector<std::int64_t>& times = *curve.times;
  if (next < times.size() && times[next] == time) {
    cursor = next;
    return curve.values[next];
  }
  return fbx_value_anywhere(curve, time, ticks_per_second, cursor);
}

/// Returns the places of the values among the properties of a `Key` of version 6. Errors: as in
/// reading.
std::vector<std::uint32_t> fbx_value_places(const FbxTree& tree, const FbxRecord& keys);

/// Reads curves of one file. Curves with the same packed key times share them.
class FbxKeyReader {
 public:
  explicit FbxKeyReader(const FbxTree& tree) : tree_(tree) {}

  /// Reads the curve of an `AnimationCurve` (version 7), or of a `Channel` with keys (version 6),
  /// in two steps. `begin` reads the key times, which show whether the curve has keys, and all of a
  /// `Channel`. `finish`, which may run for several curves in parallel, fills in values and shapes.
  /// A curve without keys has no values. Errors: `unreadable_input` for key times that do not
  /// ascend, counts that disagree, an unknown letter, or more keys than the file's bytes can hold.
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
