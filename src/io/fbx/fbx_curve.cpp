// Evaluates animation curves between, before and after their keys, and decodes key times, values
// and tangents from arrays (version 7) and from lists with letters (6).
#include "io/fbx/fbx_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/portable.hpp"
#include "base/text.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/reading_limits.hpp"

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

namespace {

// Bits of KeyAttrFlags, as text files of version 7 list them beside the number.
constexpr std::uint32_t flag_constant = 0x2, flag_linear = 0x4, flag_cubic = 0x8;
constexpr std::uint32_t flag_auto = 0x100, flag_tcb = 0x200, flag_user = 0x400;
constexpr std::uint32_t flag_clamp = 0x1000, flag_time_independent = 0x2000,
                        flag_clamp_progressive = 0x4000;
constexpr std::uint32_t flag_weighted_right = 0x1000000, flag_weighted_next_left = 0x2000000;
// The two weights share 32 bits, in units of 1 / 9999.
constexpr double weight_unit = 9999;
constexpr std::size_t data_per_shape = 4;

FbxKeyShape shape_of(std::uint32_t flags, const float* data) {
  FbxKeyShape shape;
  if ((flags & flag_constant) != 0) {
    shape.kind = (flags & flag_auto) != 0 ? FbxKeyShape::constant_next : FbxKeyShape::constant;
  } else if ((flags & flag_cubic) != 0) {
    shape.kind = (flags & flag_tcb) != 0                          ? FbxKeyShape::cubic_tcb
                 : (flags & (flag_auto | flag_user)) == flag_auto ? FbxKeyShape::cubic_auto
                                                                  : FbxKeyShape::cubic;
  } else {
    shape.kind = (flags & flag_linear) != 0 ? FbxKeyShape::linear : FbxKeyShape::constant;
  }
  shape.is_time_independent = (flags & flag_time_independent) != 0;
  shape.is_clamped = (flags & (flag_clamp | flag_clamp_progressive)) != 0;
  shape.right_slope = std::isfinite(data[0]) ? data[0] : 0;
  shape.next_left_slope = std::isfinite(data[1]) ? data[1] : 0;
  if (shape.kind == FbxKeyShape::cubic_tcb) {
    shape.bias = std::isfinite(data[2]) ? data[2] : 0;
    return shape;
  }
  const auto weights = bits_as<std::uint32_t>(data[2]);
  const auto weight_of = [](std::uint32_t units) {
    return static_cast<float>(std::min(units / weight_unit, 1.0));
  };
  if ((flags & flag_weighted_right) != 0) shape.right_weight = weight_of(weights & 0xFFFF);
  if ((flags & flag_weighted_next_left) != 0) shape.next_left_weight = weight_of(weights >> 16);
  return shape;
}

// Reads slopes and weights; most text files write the bits of the floats as integers.
std::vector<float> shape_data(const FbxTree& tree, const FbxRecord& record) {
  const std::vector<double> numbers = fbx_numbers(tree, record);
  const auto may_be_bits = [](double number) {
    return number == std::floor(number) && std::fabs(number) < 4.3e9;
  };
  const bool is_bits = tree.is_text && std::all_of(numbers.begin(), numbers.end(), may_be_bits);
  std::vector<float> data;
  data.reserve(numbers.size());
  for (const double number : numbers) {
    data.push_back(
        is_bits ? bits_as<float>(static_cast<std::uint32_t>(static_cast<std::int64_t>(number)))
                : static_cast<float>(number));
  }
  return data;
}

FbxExtrapolation extrapolation_of(const FbxTree& tree, std::uint32_t curve, std::string_view name) {
  FbxExtrapolation way;
  const std::uint32_t record = tree.child(curve, name);
  if (record == no_fbx_record) return way;
  const FbxProperty* const type = fbx_child_value(tree, record, "Type");
  const std::string_view letter = type == nullptr ? std::string_view{} : fbx_text(tree, *type);
  if (!letter.empty()) way.type = letter.front();
  way.repetitions = fbx_child_integer(tree, record, "Repetition", -1);
  return way;
}

// Walks over the properties of a `Key` of version 6: time, value, a letter, and the values that the
// letter requires.
class KeyLetters {
 public:
  KeyLetters(const FbxTree& tree, const FbxRecord& record) : tree_(tree), record_(record) {}

  std::uint32_t next() const { return next_; }
  bool at_end() const { return next_ >= record_.property_count; }

  std::int64_t integer() { return value(fbx_integer, "expected the time of a key"); }
  double number() { return value(fbx_number, "expected a number of a key"); }

  char letter() {
    const FbxProperty& property = take();
    const std::string_view text = fbx_text(tree_, property);
    if (text.size() != 1) throw tree_.error_at(property.begin, "expected a letter of a key");
    return text.front();
  }

  Error unknown(char found) const {
    const FbxProperty& property = tree_.properties[record_.first_property + next_ - 1];
    return tree_.error_at(property.begin,
                          fmt::format("unknown letter {} of a key", quote({&found, 1})));
  }

  FbxKeyShape shape() {
    FbxKeyShape shape;
    const char kind = letter();
    if (kind == 'L') return shape;
    const char mode = letter();
    if (kind == 'C') {
      shape.kind = mode == 'n' ? FbxKeyShape::constant_next : FbxKeyShape::constant;
      return shape;
    }
    if (kind != 'U' && kind != 'A') throw unknown(kind);
    shape.kind = mode == 'a' ? FbxKeyShape::cubic_auto : FbxKeyShape::cubic;
    if (mode != 'a') {
      shape.right_slope = static_cast<float>(number());
      shape.next_left_slope = static_cast<float>(number());
    }
    const char weights = letter();
    if (weights == 'a' || weights == 'r') shape.right_weight = static_cast<float>(number());
    if (weights == 'a' || weights == 'l') shape.next_left_weight = static_cast<float>(number());
    return shape;
  }

 private:
  template <class Number>
  Number value(std::optional<Number> (*read)(const FbxTree&, const FbxProperty&),
               std::string_view otherwise) {
    const FbxProperty& property = take();
    const std::optional<Number> found = read(tree_, property);
    if (!found) throw tree_.error_at(property.begin, otherwise);
    return *found;
  }

  const FbxProperty& take() {
    if (at_end()) throw tree_.error_at(record_.properties_end, "the list of keys ends in a key");
    return tree_.properties[record_.first_property + next_++];
  }

  const FbxTree& tree_;
  const FbxRecord& record_;
  std::uint32_t next_ = 0;
};

}  // namespace

std::vector<std::uint32_t> fbx_value_places(const FbxTree& tree, const FbxRecord& keys) {
  std::vector<std::uint32_t> places;
  KeyLetters letters(tree, keys);
  while (!letters.at_end()) {
    letters.integer();
    places.push_back(letters.next());
    letters.number();
    letters.shape();
  }
  return places;
}

FbxCurve FbxKeyReader::begin(std::uint32_t record) {
  const std::uint32_t letters = tree_.child(record, "Key");
  FbxCurve curve;
  curve.record = record;
  if (letters != no_fbx_record) {
    read_letters(tree_.records[letters], fbx_child_integer(tree_, record, "KeyCount", 0), curve);
  } else {
    begin_arrays(record, curve);
  }
  curve.before = extrapolation_of(tree_, record, "Pre-Extrapolation");
  curve.after = extrapolation_of(tree_, record, "Post-Extrapolation");
  return curve;
}

void FbxKeyReader::count_keys(const FbxRecord& record, std::size_t keys) {
  keys_ += keys;
  if (keys_ * sizeof(double) > memory_limit(tree_.bytes.size())) {
    throw tree_.error_at(record.begin, fmt::format("the curves have {} keys: too much memory for a "
                                                   "file of {} bytes",
                                                   keys_, tree_.bytes.size()));
  }
}

void FbxKeyReader::begin_arrays(std::uint32_t record, FbxCurve& curve) {
  const std::uint32_t times = tree_.child(record, "KeyTime");
  const std::uint32_t values = tree_.child(record, "KeyValueFloat");
  if (times == no_fbx_record || values == no_fbx_record) return;
  count_keys(tree_.records[values], fbx_count(tree_, tree_.records[values]));
  curve.times = times_of(tree_.records[times]);
}

void FbxKeyReader::finish(FbxCurve& curve) const {
  // Keys with letters are already complete.
  if (curve.times == nullptr || !curve.values.empty()) return;
  const std::uint32_t values = tree_.child(curve.record, "KeyValueFloat");
  if (values == no_fbx_record) return;
  curve.values = fbx_numbers(tree_, tree_.records[values]);
  for (double& value : curve.values) {
    if (!(std::fabs(value) <= largest_fbx_value)) value = std::nan("");
  }
  if (curve.values.size() != curve.times->size()) {
    throw tree_.error_at(tree_.records[values].begin,
                         fmt::format("a curve has {} key times, but {} values", curve.times->size(),
                                     curve.values.size()));
  }
  read_shapes(curve);
}

void FbxKeyReader::read_shapes(FbxCurve& curve) const {
  const std::uint32_t flags = tree_.child(curve.record, "KeyAttrFlags");
  const std::uint32_t data = tree_.child(curve.record, "KeyAttrDataFloat");
  const std::uint32_t counts = tree_.child(curve.record, "KeyAttrRefCount");
  if (flags == no_fbx_record || data == no_fbx_record || counts == no_fbx_record) {
    curve.shapes.emplace_back();
    return;
  }
  const auto words = fbx_integers(tree_, tree_.records[flags]);
  const auto numbers = shape_data(tree_, tree_.records[data]);
  const auto uses = fbx_integers(tree_, tree_.records[counts]);
  for (std::size_t i = 0; i < words.size(); ++i) {
    constexpr float none[data_per_shape] = {};
    const bool has_data = (i + 1) * data_per_shape <= numbers.size();
    const FbxKeyShape shape = shape_of(static_cast<std::uint32_t>(words[i]),
                                       has_data ? numbers.data() + i * data_per_shape : none);
    const std::size_t room = curve.values.size() - curve.shapes.size();
    const auto wanted = i < uses.size() && uses[i] > 0 ? static_cast<std::size_t>(uses[i]) : 0;
    if (words.size() == 1) {
      curve.shapes.assign(1, shape);
      return;
    }
    curve.shapes.insert(curve.shapes.end(), std::min(wanted, room), shape);
  }
  curve.shapes.resize(curve.values.size());
}

std::shared_ptr<const std::vector<std::int64_t>> FbxKeyReader::times_of(const FbxRecord& record) {
  const FbxProperty* const array = fbx_array(tree_, record);
  const std::string_view packed = array == nullptr ? std::string_view{} : tree_.text_of(*array);
  if (shared_times_ == nullptr || packed != last_times_) {
    auto times = fbx_integers(tree_, record);
    check_times(record, times);
    shared_times_ = std::make_shared<const std::vector<std::int64_t>>(std::move(times));
    last_times_ = packed;
  }
  return shared_times_;
}

void FbxKeyReader::check_times(const FbxRecord& record,
                               const std::vector<std::int64_t>& times) const {
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] > largest_fbx_time || times[k] < -largest_fbx_time)
      throw tree_.error_at(record.begin, fmt::format("key {} has the time {} ticks", k, times[k]));
    if (k > 0 && times[k] <= times[k - 1]) {
      throw tree_.error_at(record.begin,
                           fmt::format("the times of keys {} and {} do not ascend", k - 1, k));
    }
  }
}

void FbxKeyReader::read_letters(const FbxRecord& keys, std::int64_t count, FbxCurve& curve) const {
  std::vector<std::int64_t> times;
  KeyLetters letters(tree_, keys);
  while (!letters.at_end()) {
    times.push_back(letters.integer());
    const double value = letters.number();
    curve.values.push_back(std::fabs(value) <= largest_fbx_value ? value : std::nan(""));
    curve.shapes.push_back(letters.shape());
  }
  if (count != static_cast<std::int64_t>(times.size())) {
    throw tree_.error_at(keys.begin,
                         fmt::format("KeyCount says {}, there are {} keys", count, times.size()));
  }
  check_times(keys, times);
  curve.times = std::make_shared<const std::vector<std::int64_t>>(std::move(times));
}

}  // namespace kinemend
