// Evaluates animation curves between, before and after their keys.
#include "io/fbx/fbx_curve.hpp"

#include <algorithm>
#include <cmath>

namespace kinemend {

namespace {

constexpr double third = 1.0 / 3;

// Returns the curve parameter (0 to 1) at which a weighted tangent's curve reaches the share `x` of
// time: the root of a cubic with control points 0, first, second and 1.
double fbx_bezier_share(double x, double first, double second) {
  double low = 0, high = 1, share = x;
  for (int i = 0; i < 60 && high - low > 1e-14; ++i) {
    const double rest = 1 - share;
    const double time =
        3 * rest * rest * share * first + 3 * rest * share * share * second + share * share * share;
    (time < x ? low : high) = share;
    share = 0.5 * (low + high);
  }
  return share;
}

struct FbxSlopes {
  double right = 0;      // slope at the key
  double next_left = 0;  // slope at the next key
};

class CurveSegment {
 public:
  CurveSegment(const FbxCurve& curve, std::size_t key, double ticks_per_second)
      : curve_(curve), key_(key), ticks_(ticks_per_second) {}

  double at(std::int64_t time) const {
    const FbxKeyShape& shape = curve_.shape(key_);
    const double from = curve_.values[key_], to = curve_.values[key_ + 1];
    const double step = seconds(key_, key_ + 1);
    const double x = static_cast<double>(time - times()[key_]) / (step * ticks_);
    switch (shape.kind) {
      case FbxKeyShape::constant:
        return from;
      case FbxKeyShape::constant_next:
        return to;
      case FbxKeyShape::linear:
        return from + x * (to - from);
      default:
        return bezier(x, from, to, step, shape);
    }
  }

  FbxSlopes slopes(const FbxKeyShape& shape) const {
    if (shape.kind == FbxKeyShape::cubic) return {shape.right_slope, shape.next_left_slope};
    if (shape.kind == FbxKeyShape::cubic_auto) return {auto_slope(key_), auto_slope(key_ + 1)};
    if (shape.kind == FbxKeyShape::cubic_tcb) return {tcb_slope(key_, 1), tcb_slope(key_ + 1, -1)};
    if (shape.kind == FbxKeyShape::linear) {
      const double slope = secant(key_);
      return {slope, slope};
    }
    return {};
  }

 private:
  const std::vector<std::int64_t>& times() const { return *curve_.times; }

  double seconds(std::size_t from, std::size_t to) const {
    return (static_cast<double>(times()[to]) - static_cast<double>(times()[from])) / ticks_;
  }

  double secant(std::size_t key) const {
    return (curve_.values[key + 1] - curve_.values[key]) / seconds(key, key + 1);
  }

  double bezier(double x, double from, double to, double step, const FbxKeyShape& shape) const {
    const FbxSlopes slope = slopes(shape);
    const double first = shape.right_weight > 0 ? shape.right_weight : third;
    const double second = shape.next_left_weight > 0 ? shape.next_left_weight : third;
    const bool is_even = first == third && second == third;
    const double share = is_even ? x : fbx_bezier_share(x, first, 1 - second);
    const double rest = 1 - share;
    const double after = from + slope.right * first * step;
    const double before = to - slope.next_left * second * step;
    return rest * rest * rest * from + 3 * rest * rest * share * after +
           3 * rest * share * share * before + share * share * share * to;
  }

  // Returns the slope through the neighbours of a key; zero at either end.
  double auto_slope(std::size_t key) const {
    if (key == 0 || key + 1 >= curve_.key_count()) return 0;
    const FbxKeyShape& shape = curve_.shape(key);
    const double left = secant(key - 1), right = secant(key);
    const double share = seconds(key - 1, key) / seconds(key - 1, key + 1);
    const double weight = shape.is_time_independent ? share : 1 - share;
    const double slope = left * (1 - weight) + right * weight;
    if (!shape.is_clamped) return slope;
    if (left * right <= 0) return 0;
    const double most = 3 * std::min(std::fabs(left), std::fabs(right));
    return std::clamp(slope, -most, most);
  }

  // Kochanek and Bartels 1984, equations 8 and 9; `side`: 1 behind the key, -1 before it.
  double tcb_slope(std::size_t key, double side) const {
    const FbxKeyShape& shape = curve_.shape(key);
    const double left = key > 0 ? secant(key - 1) : secant(key);
    const double right = key + 1 < curve_.key_count() ? secant(key) : left;
    const double tension = shape.right_slope, continuity = side * shape.next_left_slope;
    return 0.5 * (1 - tension) *
           ((1 + continuity) * (1 + shape.bias) * left +
            (1 - continuity) * (1 - shape.bias) * right);
  }

  const FbxCurve& curve_;
  std::size_t key_;
  double ticks_;
};

double fbx_value_between(const FbxCurve& curve, std::int64_t time, double ticks,
                         std::size_t& cursor) {
  const std::vector<std::int64_t>& times = *curve.times;
  const std::size_t last = times.size() - 1;
  if (cursor >= last || times[cursor] > time || (cursor + 2 <= last && times[cursor + 2] <= time)) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    cursor = static_cast<std::size_t>(after - times.begin());
    cursor = cursor == 0 ? 0 : cursor - 1;
  } else if (times[cursor + 1] <= time) {
    ++cursor;
  }
  if (cursor >= last) return curve.values[last];
  if (times[cursor] == time) return curve.values[cursor];
  return CurveSegment(curve, cursor, ticks).at(time);
}

// Returns the value `distance` ticks (positive) beyond an end, for a curve of at least two keys.
double fbx_value_beyond(const FbxCurve& curve, bool is_after, double distance, double ticks) {
  const FbxExtrapolation& way = is_after ? curve.after : curve.before;
  const std::vector<std::int64_t>& times = *curve.times;
  const std::size_t last = times.size() - 1;
  const double end = is_after ? curve.values[last] : curve.values[0];
  if (way.type == 'K') {
    const std::size_t key = is_after ? last - 1 : 0;
    const CurveSegment segment(curve, key, ticks);
    const FbxSlopes slopes = segment.slopes(curve.shape(key));
    return is_after ? end + slopes.next_left * distance / ticks
                    : end - slopes.right * distance / ticks;
  }
  if (way.type != 'R' && way.type != 'A' && way.type != 'M') return end;
  const double span = static_cast<double>(times[last]) - static_cast<double>(times[0]);
  double turn = std::floor(distance / span);
  double rest = distance - turn * span;
  if (way.repetitions >= 0 && turn >= static_cast<double>(way.repetitions)) {
    turn = static_cast<double>(way.repetitions) - 1;
    rest = span;
  }
  if (turn < 0) return end;
  const bool mirrored = way.type == 'M' && std::fmod(turn, 2) == 0;
  const double from_start = is_after != mirrored ? rest : span - rest;
  std::size_t cursor = 0;
  const auto time = times[0] + static_cast<std::int64_t>(std::llround(from_start));
  const double value = fbx_value_between(curve, time, ticks, cursor);
  if (way.type != 'A') return value;
  const double rise = (curve.values[last] - curve.values[0]) * (turn + 1);
  return is_after ? value + rise : value - rise;
}

}  // namespace

bool FbxCurve::is_constant() const {
  for (const double value : values) {
    if (!(value == values.front())) return false;
  }
  for (std::size_t k = 0; k + 1 < values.size(); ++k) {
    const FbxKeyShape& way = shape(k);
    if (way.kind == FbxKeyShape::cubic && (way.right_slope != 0 || way.next_left_slope != 0))
      return false;
    if (shapes.size() == 1) break;
  }
  return true;
}

double fbx_value_anywhere(const FbxCurve& curve, std::int64_t time, double ticks_per_second,
                          std::size_t& cursor) {
  const std::vector<std::int64_t>& times = *curve.times;
  if (times.size() > 1 && (time < times.front() || time > times.back())) {
    const bool is_after = time > times.back();
    const double end = static_cast<double>(is_after ? times.back() : times.front());
    return fbx_value_beyond(curve, is_after, std::fabs(static_cast<double>(time) - end),
                            ticks_per_second);
  }
  return fbx_value_between(curve, time, ticks_per_second, cursor);
}

}  // namespace kinemend
