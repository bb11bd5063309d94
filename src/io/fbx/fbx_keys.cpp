// Decodes key times, values and tangents from arrays (version 7) and from lists with letters (6).
#include "io/fbx/fbx_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/bits.hpp"
#include "base/quote.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/memory_limit.hpp"

namespace kinemend {

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

  std::int64_t integer() {
    const FbxProperty& property = take();
    const auto value = fbx_integer(tree_, property);
    if (!value) throw tree_.error_at(property.begin, "expected the time of a key");
    return *value;
  }

  double number() {
    const FbxProperty& property = take();
    const auto value = fbx_number(tree_, property);
    if (!value) throw tree_.error_at(property.begin, "expected a number of a key");
    return *value;
  }

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

FbxCurve FbxKeyReader::read(std::uint32_t record) {
  FbxCurve curve = begin(record);
  finish(curve);
  return curve;
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
