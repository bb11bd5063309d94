// Decodes the values of FBX records, including packed arrays.
#include "io/fbx/fbx_values.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/fbx/fbx_tree.hpp"
#include "io/reading_limits.hpp"
#include "io/text/number.hpp"

namespace kinemend {

namespace {

constexpr std::uint32_t packing_none = 0, packing_zlib = 1;

std::optional<double> number_in_text(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const NumberToken token = read_number(text.data(), text.data() + text.size());
  if (token.kind == TokenKind::number) return token.value;
  if (token.kind == TokenKind::not_finite) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

std::optional<std::int64_t> integer_in_text(std::string_view text) {
  std::int64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc{} && result.ptr == text.data() + text.size()) return value;
  const std::optional<double> number = number_in_text(text);
  if (number && std::fabs(*number) < 9e18) return static_cast<std::int64_t>(*number);
  return std::nullopt;
}

double element(const char* bytes, char type, bool big) {
  switch (type) {
    case 'd':
      return fbx_double(bytes, big);
    case 'f':
      return static_cast<double>(fbx_float(bytes, big));
    case 'l':
      return static_cast<double>(static_cast<std::int64_t>(read_word<std::uint64_t>(bytes, big)));
    case 'i':
      return static_cast<std::int32_t>(read_word<std::uint32_t>(bytes, big));
    default:
      return static_cast<unsigned char>(*bytes);
  }
}

std::int64_t integer_element(const char* bytes, char type, bool big) {
  if (type == 'l') return static_cast<std::int64_t>(read_word<std::uint64_t>(bytes, big));
  const double value = element(bytes, type, big);
  return std::fabs(value) < 9e18 ? static_cast<std::int64_t>(value) : 0;
}

// Rejects counts that are too large for the file before allocating memory.
void check_array_size(const FbxTree& tree, const FbxProperty& array, std::size_t raw_bytes) {
  if (raw_bytes <= memory_limit(tree.bytes.size())) return;
  throw tree.error_at(array.begin, fmt::format("an array of {} bytes: too much for a file of {}",
                                               raw_bytes, tree.bytes.size()));
}

// Calls `take(position, type)` for each number in the order of the file.
template <class Value, class OfBytes, class OfText>
std::vector<Value> values_of(const FbxTree& tree, const FbxRecord& record, OfBytes&& of_bytes,
                             OfText&& of_text) {
  std::vector<Value> values;
  const FbxProperty* const array = fbx_array(tree, record);
  const auto refuse = [&](std::size_t place) { return tree.error_at(place, "expected a number"); };
  if (array != nullptr && tree.is_text) {
    const std::vector<FbxToken> tokens = fbx_tokens(tree, *array);
    values.reserve(tokens.size());
    for (const FbxToken& token : tokens) {
      const auto value =
          of_text(std::string_view(tree.bytes).substr(token.begin, token.end - token.begin));
      if (!value) throw refuse(token.begin);
      values.push_back(*value);
    }
  } else if (array != nullptr) {
    const std::string raw = fbx_unpacked(tree, *array);
    const std::size_t width = fbx_number_bytes(array->type);
    values.resize(raw.size() / width);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = of_bytes(raw.data() + i * width, array->type, tree.is_big_endian);
  }
  return values;
}

}  // namespace

std::optional<double> fbx_number(const FbxTree& tree, const FbxProperty& property) {
  const char* const bytes = tree.bytes.data() + property.begin;
  switch (property.type) {
    case 'D':
      return fbx_double(bytes, tree.is_big_endian);
    case 'F':
      return static_cast<double>(fbx_float(bytes, tree.is_big_endian));
    case 'N':
    case 'W':
      return number_in_text(tree.text_of(property));
    default:
      if (const auto integer = fbx_integer(tree, property)) return static_cast<double>(*integer);
      return std::nullopt;
  }
}

std::optional<std::int64_t> fbx_integer(const FbxTree& tree, const FbxProperty& property) {
  const char* const bytes = tree.bytes.data() + property.begin;
  const bool big = tree.is_big_endian;
  switch (property.type) {
    case 'B':
    case 'C':
      return static_cast<unsigned char>(*bytes);
    case 'Y':
      return static_cast<std::int16_t>(read_word<std::uint16_t>(bytes, big));
    case 'I':
      return static_cast<std::int32_t>(read_word<std::uint32_t>(bytes, big));
    case 'L':
      return static_cast<std::int64_t>(read_word<std::uint64_t>(bytes, big));
    case 'N':
    case '*':
      return integer_in_text(tree.text_of(property));
    case 'D':
    case 'F': {
      const std::optional<double> number = fbx_number(tree, property);
      if (number && std::fabs(*number) < 9e18) return static_cast<std::int64_t>(*number);
      return std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

std::string_view fbx_text(const FbxTree& tree, const FbxProperty& property) {
  if (property.type == 'S' && !tree.is_text) return tree.text_of(property).substr(4);
  if (property.type == 'S' || property.type == 'W' || property.type == 'C')
    return tree.text_of(property);
  return {};
}

const FbxProperty* fbx_child_value(const FbxTree& tree, std::uint32_t record,
                                   std::string_view name) {
  const std::uint32_t child = tree.child(record, name);
  return child == no_fbx_record ? nullptr : tree.property(tree.records[child], 0);
}

std::int64_t fbx_child_integer(const FbxTree& tree, std::uint32_t record, std::string_view name,
                               std::int64_t otherwise) {
  const FbxProperty* const value = fbx_child_value(tree, record, name);
  return value == nullptr ? otherwise : fbx_integer(tree, *value).value_or(otherwise);
}

std::string fbx_object_name(const FbxTree& tree, const FbxProperty& property) {
  std::string_view text = fbx_text(tree, property);
  if (!tree.is_text) {
    const std::size_t end = text.find(std::string_view("\0\1", 2));
    return std::string(text.substr(0, end));
  }
  const std::size_t colons = text.find("::");
  if (colons != text.npos) text.remove_prefix(colons + 2);
  std::string name(text);
  constexpr std::string_view escaped = "&quot;";
  for (std::size_t at = name.find(escaped); at != name.npos; at = name.find(escaped, at + 1))
    name.replace(at, escaped.size(), 1, '"');
  return name;
}

const FbxProperty* fbx_array(const FbxTree& tree, const FbxRecord& record) {
  if (!tree.is_text) {
    const FbxProperty* const first = tree.property(record, 0);
    return first != nullptr && first->type >= 'a' && first->type <= 'z' ? first : nullptr;
  }
  if (record.first_child == no_fbx_record) return nullptr;
  const FbxProperty* const first = tree.property(tree.records[record.first_child], 0);
  return first != nullptr && first->type == 'A' ? first : nullptr;
}

std::string fbx_unpacked(const FbxTree& tree, const FbxProperty& array) {
  const FbxArrayHead head = fbx_array_head(tree, array.begin);
  const std::size_t raw_bytes = head.count * fbx_number_bytes(array.type);
  const char* const data = tree.bytes.data() + array.begin + fbx_array_head_bytes;
  if (head.packing == packing_none) return {data, raw_bytes};
  if (head.packing != packing_zlib)
    throw tree.error_at(array.begin, fmt::format("unknown packing {} of an array", head.packing));
  check_array_size(tree, array, raw_bytes);
  std::string raw(raw_bytes, '\0');
  uLongf written = raw_bytes;
  const int result =
      uncompress(reinterpret_cast<Bytef*>(raw.data()), &written,
                 reinterpret_cast<const Bytef*>(data), static_cast<uLong>(head.packed_bytes));
  if (raw_bytes > 0 && (result != Z_OK || written != raw_bytes))
    throw tree.error_at(array.begin, "the packed numbers of an array are damaged");
  return raw;
}

std::string fbx_zlib(std::string_view raw) {
  // Faster than zlib's default level: the digits of measured motion hardly shrink at any level.
  constexpr int level = 1;
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
            reinterpret_cast<const Bytef*>(raw.data()), static_cast<uLong>(raw.size()), level);
  packed.resize(size);
  return packed;
}

std::string fbx_packed(const FbxTree& tree, const FbxProperty& array, const std::string& raw) {
  const FbxArrayHead head = fbx_array_head(tree, array.begin);
  std::string data = raw;
  if (head.packing == packing_zlib) {
    data = fbx_zlib(raw);
  }
  std::string bytes(fbx_array_head_bytes, '\0');
  const bool big = tree.is_big_endian;
  const auto count = static_cast<std::uint32_t>(raw.size() / fbx_number_bytes(array.type));
  put_word(bytes.data(), count, big);
  put_word(bytes.data() + 4, head.packing, big);
  put_word(bytes.data() + 8, static_cast<std::uint32_t>(data.size()), big);
  return bytes + data;
}

std::vector<FbxToken> fbx_tokens(const FbxTree& tree, const FbxProperty& array) {
  std::vector<FbxToken> tokens;
  const std::string_view bytes(tree.bytes);
  const std::size_t end = array.begin + array.size;
  std::size_t place = array.begin;
  const auto separates = [&](std::size_t i) { return is_space(bytes[i]) || bytes[i] == ','; };
  while (place < end) {
    if (separates(place)) {
      ++place;
      continue;
    }
    const std::size_t begin = place;
    while (place < end && !separates(place)) ++place;
    tokens.push_back({begin, place});
  }
  return tokens;
}

std::size_t fbx_count(const FbxTree& tree, const FbxRecord& record) {
  const FbxProperty* const array = fbx_array(tree, record);
  if (array == nullptr) return record.property_count;
  return tree.is_text ? array->size / 2 + 1 : fbx_array_head(tree, array->begin).count;
}

std::vector<double> fbx_numbers(const FbxTree& tree, const FbxRecord& record) {
  return values_of<double>(tree, record, element, number_in_text);
}

std::vector<std::int64_t> fbx_integers(const FbxTree& tree, const FbxRecord& record) {
  return values_of<std::int64_t>(tree, record, integer_element, integer_in_text);
}

}  // namespace kinemend
