// The curve of one animated number: keys, and the interpolation between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

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

}  // namespace kinemend
