// The curve of one animated number: keys, and how to get from one to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace kinemend {

/// Values beyond it are not positions or angles, but damage.
inline constexpr double largest_fbx_value = 1e30;
/// Some 578 days; far from where sums of times overflow.
inline constexpr std::int64_t largest_fbx_time = std::int64_t{1} << 61;

/// How a curve goes from a key to the next one.
struct FbxKeyShape {
  enum Kind : std::uint8_t { constant, constant_next, linear, cubic, cubic_auto, cubic_tcb };
  Kind kind = linear;
  bool is_time_independent = false;  ///< of `cubic_auto`: neighbours count alike
  bool is_clamped = false;           ///< of `cubic_auto`: no overshoot
  /// Of `cubic`: value units a second at this key and at the next. Of `cubic_tcb`: tension,
  /// continuity.
  float right_slope = 0, next_left_slope = 0;
  float bias = 0;                                ///< of `cubic_tcb`
  float right_weight = 0, next_left_weight = 0;  ///< share of the step; 0 where not weighted
};

/// What a curve is before its first key or after its last.
struct FbxExtrapolation {
  /// C holds the key, K goes on with its slope, R repeats, A repeats from the last value, M
  /// mirrors.
  char type = 'C';
  std::int64_t repetitions = -1;  ///< negative: without end
};

struct FbxCurve {
  std::uint32_t record = 0;
  std::shared_ptr<const std::vector<std::int64_t>> times;  ///< ticks, ascending
  std::vector<double> values;       ///< one a key, at least one; NaN where not finite
  std::vector<FbxKeyShape> shapes;  ///< one, or one a key
  FbxExtrapolation before, after;

  std::size_t key_count() const { return values.size(); }
  const FbxKeyShape& shape(std::size_t key) const { return shapes[shapes.size() == 1 ? 0 : key]; }
  /// Whether it is the same number always.
  bool is_constant() const;
};

/// The value at any time; see `fbx_value_at`.
double fbx_value_anywhere(const FbxCurve& curve, std::int64_t time, double ticks_per_second,
                          std::size_t& cursor);

/// The value at a time. `cursor`: 0 at first, then what the last call left; makes successive times
/// quick. `ticks_per_second`: of the file.
inline double fbx_value_at(const FbxCurve& curve, std::int64_t time, double ticks_per_second,
                           std::size_t& cursor) {
  // Mostly the next key is asked for.
  const std::size_t next = cursor + 1;
  const std::vector<std::int64_t>& times = *curve.times;
  if (next < times.size() && times[next] == time) {
    cursor = next;
    return curve.values[next];
  }
  return fbx_value_anywhere(curve, time, ticks_per_second, cursor);
}

}  // namespace kinemend
