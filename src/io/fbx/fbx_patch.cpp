// Moves the bytes after a patch, and encodes keys in the form of the file: packed arrays, text, or
// lists with letters (version 6).
#include "io/fbx/fbx_patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/portable.hpp"
#include "io/fbx/fbx_curve.hpp"
#include "io/fbx/fbx_tree.hpp"
#include "io/fbx/fbx_values.hpp"

namespace kinemend {

namespace {

constexpr std::size_t footer_alignment = 16, zeros_after_padding = 4;
constexpr std::size_t footer_head = 16;

class FbxPatcher {
 public:
  FbxPatcher(const FbxTree& tree, std::vector<FbxPatch> patches)
      : tree_(tree), patches_(std::move(patches)) {
    std::sort(patches_.begin(), patches_.end(), [](const FbxPatch& a, const FbxPatch& b) {
      return std::tie(a.begin, a.end) < std::tie(b.begin, b.end);
    });
    std::ptrdiff_t shift = 0;
    for (const FbxPatch& patch : patches_) {
      shift += static_cast<std::ptrdiff_t>(patch.bytes.size()) -
               static_cast<std::ptrdiff_t>(patch.end - patch.begin);
      shifts_.push_back(shift);
      if (patch.more_properties != 0) grown_.emplace(patch.begin, patch.more_properties);
    }
  }

  std::string write() {
    std::string out;
    out.reserve(moved(tree_.bytes.size()) + footer_alignment);
    std::size_t from = 0;
    for (const FbxPatch& patch : patches_) {
      out.append(tree_.bytes, from, patch.begin - from);
      out += patch.bytes;
      from = patch.end;
    }
    out.append(tree_.bytes, from);
    const bool moves = !grown_.empty() ||
                       std::any_of(shifts_.begin(), shifts_.end(), [](auto s) { return s != 0; });
    if (!tree_.is_text && moves) {
      for (const FbxRecord& record : tree_.records) mend_header(record, out);
      pad_footer(out);
    }
    return out;
  }

 private:
  // Returns the new offset of a byte that is not within a patch.
  std::size_t moved(std::size_t place) const {
    const auto after =
        std::upper_bound(patches_.begin(), patches_.end(), place,
                         [](std::size_t at, const FbxPatch& patch) { return at < patch.end; });
    if (after == patches_.begin()) return place;
    const auto index = static_cast<std::size_t>(after - patches_.begin()) - 1;
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(place) + shifts_[index]);
  }

  template <class Word>
  void put(std::string& out, std::size_t place, std::size_t value) const {
    put_word(out.data() + place, static_cast<Word>(value), tree_.is_big_endian);
  }

  void mend_header(const FbxRecord& record, std::string& out) const {
    const std::size_t place = moved(record.begin);
    const std::size_t end = moved(record.end);
    const std::size_t list = moved(record.properties_end) - moved(record.properties_begin);
    const auto grown = grown_.find(record.properties_begin);
    const std::size_t count =
        record.property_count + static_cast<std::size_t>(grown == grown_.end() ? 0 : grown->second);
    if (tree_.has_wide_headers()) {
      put<std::uint64_t>(out, place, end);
      put<std::uint64_t>(out, place + 8, count);
      put<std::uint64_t>(out, place + 16, list);
    } else {
      put<std::uint32_t>(out, place, end);
      put<std::uint32_t>(out, place + 4, count);
      put<std::uint32_t>(out, place + 8, list);
    }
  }

  // Zeros between the head of the footer and the version align the version.
  void pad_footer(std::string& out) const {
    const std::size_t zeros_begin = tree_.records_end + footer_head;
    const std::size_t version_place = place_of_version(zeros_begin);
    if (version_place == 0) return;
    const std::size_t phase = version_place % footer_alignment;
    const std::size_t begin = moved(tree_.records_end) + footer_head;
    // Autodesk pads with 1 to 16 bytes and adds four; Blender adds four and pads with 1 to 16.
    const std::size_t least = begin + 1 + (phase == 0 ? zeros_after_padding : 0);
    const std::size_t aligned =
        (least + footer_alignment - 1) / footer_alignment * footer_alignment;
    out.replace(begin, version_place - zeros_begin, aligned + phase - begin, '\0');
  }

  // Returns the offset of the version in the source file; 0 if its footer has another form.
  std::size_t place_of_version(std::size_t zeros_begin) const {
    constexpr std::size_t most_zeros = footer_alignment + zeros_after_padding;
    const std::string& bytes = tree_.bytes;
    for (std::size_t i = 0; i <= most_zeros && zeros_begin + i + 4 <= bytes.size(); ++i) {
      const std::size_t place = zeros_begin + i;
      const std::size_t phase = place % footer_alignment;
      const auto word = read_word<std::uint32_t>(bytes.data() + place, tree_.is_big_endian);
      if (word == tree_.version && (phase == 0 || phase == zeros_after_padding)) return place;
      if (bytes[place] != 0) return 0;
    }
    return 0;
  }

  const FbxTree& tree_;
  std::vector<FbxPatch> patches_;
  std::vector<std::ptrdiff_t> shifts_;
  std::unordered_map<std::size_t, std::int64_t> grown_;  // by the offset of a list of properties
};

}  // namespace

std::string write_patched_fbx(const FbxTree& tree, std::vector<FbxPatch> patches) {
  if (patches.empty()) return tree.bytes;
  return FbxPatcher(tree, std::move(patches)).write();
}

namespace {

// Linear, with automatic tangents if a program makes the keys smooth again, as Autodesk's programs
// and Blender write baked curves.
constexpr std::uint32_t baked_flags = 24836;
// Weights of a third on either side, 3333 / 9999 twice.
constexpr std::uint32_t default_weights = 0x0D050D05;

bool is_same_float(double a, double b) {
  return bits_as<std::uint32_t>(static_cast<float>(a)) ==
         bits_as<std::uint32_t>(static_cast<float>(b));
}

std::string float_text(double value) { return fmt::format("{}", static_cast<float>(value)); }

void append_fbx_float(std::string& raw, double value, char type, bool big) {
  const auto rounded = static_cast<float>(value);
  if (type == 'f') return append_word(raw, bits_as<std::uint32_t>(rounded), big);
  append_word(raw, bits_as<std::uint64_t>(static_cast<double>(rounded)), big);
}

class FbxCurvePatcher {
 public:
  FbxCurvePatcher(const FbxTree& tree, const FbxCurve& curve, std::vector<FbxPatch>& patches)
      : tree_(tree), curve_(curve), patches_(patches) {}

  bool set_values(const std::vector<double>& values) {
    bool changes = false;
    for (std::size_t k = 0; k < values.size(); ++k)
      changes = changes || !is_same_float(values[k], curve_.values[k]);
    if (!changes) return false;
    const std::uint32_t letters = tree_.child(curve_.record, "Key");
    if (letters != no_fbx_record && has_stated_tangents()) {
      write_letters(letters, *curve_.times, values);
    } else if (letters != no_fbx_record) {
      set_listed(tree_.records[letters], values);
    } else {
      set_array(tree_.records[tree_.child(curve_.record, "KeyValueFloat")], values);
      if (has_stated_tangents()) straighten(values.size());
    }
    return true;
  }

  void bake(const std::vector<std::int64_t>& times, const std::vector<double>& values) {
    const std::uint32_t letters = tree_.child(curve_.record, "Key");
    if (letters != no_fbx_record) {
      write_letters(letters, times, values);
      return;
    }
    replace("KeyTime", times.size(), [&](std::size_t i) { return times[i]; });
    replace_floats("KeyValueFloat", values);
    straighten(values.size());
  }

 private:
  bool has_stated_tangents() const {
    for (const FbxKeyShape& shape : curve_.shapes) {
      if (shape.kind == FbxKeyShape::cubic) return true;
    }
    return false;
  }

  void patch(std::size_t begin, std::size_t end, std::string bytes) {
    patches_.push_back({begin, end, std::move(bytes)});
  }

  void set_array(const FbxRecord& record, const std::vector<double>& values) {
    const FbxProperty& array = *fbx_array(tree_, record);
    if (tree_.is_text) {
      const std::vector<FbxToken> tokens = fbx_tokens(tree_, array);
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (!is_same_float(values[k], curve_.values[k]))
          patch(tokens[k].begin, tokens[k].end, float_text(values[k]));
      }
      return;
    }
    std::string raw = fbx_unpacked(tree_, array);
    const std::size_t width = raw.size() / values.size();
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (is_same_float(values[k], curve_.values[k])) continue;
      std::string bytes;
      append_fbx_float(bytes, values[k], array.type, tree_.is_big_endian);
      raw.replace(k * width, width, bytes);
    }
    patch(array.begin, array.begin + array.size, fbx_packed(tree_, array, raw));
  }

  // Replaces the values in a list of version 6 in place.
  void set_listed(const FbxRecord& keys, const std::vector<double>& values) {
    const std::vector<std::uint32_t> places = fbx_value_places(tree_, keys);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (is_same_float(values[k], curve_.values[k])) continue;
      const FbxProperty& property = tree_.properties[keys.first_property + places[k]];
      std::string bytes;
      if (tree_.is_text) {
        bytes = float_text(values[k]);
      } else if (property.type == 'D' || property.type == 'F') {
        append_fbx_float(bytes, values[k], property.type == 'F' ? 'f' : 'd', tree_.is_big_endian);
      } else {
        patch_type(property, values[k]);
        continue;
      }
      patch(property.begin, property.begin + property.size, std::move(bytes));
    }
  }

  // Changes the type of a whole number that becomes a fraction.
  void patch_type(const FbxProperty& property, double value) {
    std::string bytes = "D";
    append_fbx_float(bytes, value, 'd', tree_.is_big_endian);
    patch(property.begin - 1, property.begin + property.size, std::move(bytes));
  }

  void write_letters(std::uint32_t letters, const std::vector<std::int64_t>& times,
                     const std::vector<double>& values) {
    const FbxRecord& keys = tree_.records[letters];
    std::string list;
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (tree_.is_text) {
        list += fmt::format("{}{},{},L", k == 0 ? "" : ",", times[k], float_text(values[k]));
        continue;
      }
      list += 'L';
      append_word(list, static_cast<std::uint64_t>(times[k]), tree_.is_big_endian);
      list += 'D';
      append_fbx_float(list, values[k], 'd', tree_.is_big_endian);
      list += "CL";
    }
    const std::size_t begin =
        tree_.is_text ? tree_.properties[keys.first_property].begin : keys.properties_begin;
    const auto more = static_cast<std::int64_t>(3 * times.size()) -
                      static_cast<std::int64_t>(keys.property_count);
    patches_.push_back({begin, keys.properties_end, std::move(list), tree_.is_text ? 0 : more});
    const FbxProperty* const count = fbx_child_value(tree_, curve_.record, "KeyCount");
    if (count != nullptr && times.size() != curve_.key_count())
      patches_.push_back(fbx_integer_patch(tree_, *count, static_cast<std::int64_t>(times.size())));
  }

  // Gives all keys one shape.
  void straighten(std::size_t keys) {
    replace("KeyAttrFlags", 1, [](std::size_t) { return std::int64_t{baked_flags}; });
    const std::uint32_t data[4] = {0, 0, default_weights, 0};
    const std::uint32_t found = tree_.child(curve_.record, "KeyAttrDataFloat");
    const FbxProperty* const array =
        found == no_fbx_record ? nullptr : fbx_array(tree_, tree_.records[found]);
    if (array != nullptr && holds_floats_as_text(*array)) {
      replace_array(tree_.records[found], *array, 4, "0,0,4.09994609e-31,0");
    } else if (array != nullptr && (tree_.is_text || array->type == 'f' || array->type == 'i')) {
      replace("KeyAttrDataFloat", 4,
              [&](std::size_t i) { return static_cast<std::int64_t>(data[i]); });
    }
    replace("KeyAttrRefCount", 1, [&](std::size_t) { return static_cast<std::int64_t>(keys); });
  }

  // Version 7.1 writes floats as text, later versions write their bits.
  bool holds_floats_as_text(const FbxProperty& array) const {
    return tree_.is_text && tree_.text_of(array).find('.') != std::string_view::npos;
  }

  // `value_at` gives the bits of a word: 8 bytes for l, else 4.
  template <class ValueAt>
  void replace(std::string_view name, std::size_t count, ValueAt&& value_at) {
    const std::uint32_t record = tree_.child(curve_.record, name);
    if (record == no_fbx_record) return;
    const FbxProperty* const array = fbx_array(tree_, tree_.records[record]);
    if (array == nullptr) return;
    std::string content;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t value = value_at(i);
      if (tree_.is_text) {
        content += fmt::format("{}{}", i == 0 ? "" : ",", value);
      } else if (array->type == 'l' || array->type == 'd') {
        append_word(content, static_cast<std::uint64_t>(value), tree_.is_big_endian);
      } else {
        append_word(content, static_cast<std::uint32_t>(value), tree_.is_big_endian);
      }
    }
    replace_array(tree_.records[record], *array, count, content);
  }

  void replace_floats(std::string_view name, const std::vector<double>& values) {
    const FbxRecord& record = tree_.records[tree_.child(curve_.record, name)];
    const FbxProperty& array = *fbx_array(tree_, record);
    std::string content;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (tree_.is_text) {
        if (k > 0) content += ',';
        content += float_text(values[k]);
      } else {
        append_fbx_float(content, values[k], array.type, tree_.is_big_endian);
      }
    }
    replace_array(record, array, values.size(), content);
  }

  void replace_array(const FbxRecord& record, const FbxProperty& array, std::size_t count,
                     const std::string& content) {
    if (!tree_.is_text) {
      patch(array.begin, array.begin + array.size, fbx_packed(tree_, array, content));
      return;
    }
    const FbxProperty& stated = tree_.properties[record.first_property];
    patch(stated.begin, stated.begin + stated.size, std::to_string(count));
    const std::vector<FbxToken> tokens = fbx_tokens(tree_, array);
    const std::size_t begin = tokens.empty() ? array.begin : tokens.front().begin;
    patch(begin, tokens.empty() ? begin : tokens.back().end, content);
  }

  const FbxTree& tree_;
  const FbxCurve& curve_;
  std::vector<FbxPatch>& patches_;
};

}  // namespace

bool patch_fbx_values(const FbxTree& tree, const FbxCurve& curve, const std::vector<double>& values,
                      std::vector<FbxPatch>& patches) {
  return FbxCurvePatcher(tree, curve, patches).set_values(values);
}

void bake_fbx_curve(const FbxTree& tree, const FbxCurve& curve,
                    const std::vector<std::int64_t>& times, const std::vector<double>& values,
                    std::vector<FbxPatch>& patches) {
  FbxCurvePatcher(tree, curve, patches).bake(times, values);
}

FbxPatch fbx_integer_patch(const FbxTree& tree, const FbxProperty& property, std::int64_t value) {
  FbxPatch patch{property.begin, property.begin + property.size, {}, 0};
  if (tree.is_text) {
    patch.bytes = std::to_string(value);
  } else if (property.size == 8) {
    append_word(patch.bytes, static_cast<std::uint64_t>(value), tree.is_big_endian);
  } else if (property.size == 4) {
    append_word(patch.bytes, static_cast<std::uint32_t>(value), tree.is_big_endian);
  } else {
    patch.bytes = std::string(tree.text_of(property));
  }
  return patch;
}

}  // namespace kinemend
