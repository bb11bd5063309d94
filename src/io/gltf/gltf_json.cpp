// Checks the type and the range of JSON values, and walks over JSON text by its brackets and
// quotes.
#include "io/gltf/gltf_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

// Reads a whole number, which some writers write as 5126.0.
std::optional<std::size_t> gltf_whole_value(const GltfJson& value) {
  constexpr double most = 9007199254740992.0;  // 2^53: whole numbers up to it are exact
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  if (!value.is_number_float()) return std::nullopt;
  const auto number = value.get<double>();
  if (!(number >= 0 && number <= most) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::size_t>(number);
}

}  // namespace

const GltfJson* gltf_field(const GltfJson& object, const char* key) {
  if (!object.is_object()) throw GltfFault{"expected an object"};
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<std::size_t> gltf_whole(const GltfJson& object, const char* key) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return std::nullopt;
  const auto whole = gltf_whole_value(*value);
  if (!whole) throw GltfFault{fmt::format("{} is not a whole number", key)};
  return whole;
}

std::size_t gltf_whole(const GltfJson& object, const char* key, std::size_t otherwise) {
  return gltf_whole(object, key).value_or(otherwise);
}

std::size_t gltf_needed_whole(const GltfJson& object, const char* key) {
  const auto value = gltf_whole(object, key);
  if (!value) throw GltfFault{fmt::format("{} is missing", key)};
  return *value;
}

std::string gltf_text(const GltfJson& object, const char* key) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return {};
  if (!value->is_string()) throw GltfFault{fmt::format("{} is not a text", key)};
  return value->get<std::string>();
}

bool gltf_flag(const GltfJson& object, const char* key) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) throw GltfFault{fmt::format("{} is neither true nor false", key)};
  return value->get<bool>();
}

std::optional<std::vector<double>> gltf_numbers(const GltfJson& object, const char* key,
                                                std::size_t count) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return std::nullopt;
  std::vector<double> numbers;
  if (value->is_array() && value->size() == count) {
    for (const GltfJson& element : *value) {
      if (element.is_number()) numbers.push_back(element.get<double>());
    }
  }
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (numbers.size() != count || !std::all_of(numbers.begin(), numbers.end(), is_finite))
    throw GltfFault{fmt::format("{} is not an array of {} numbers", key, count)};
  return numbers;
}

std::vector<std::size_t> gltf_indices(const GltfJson& object, const char* key, std::size_t limit) {
  std::vector<std::size_t> indices;
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return indices;
  if (!value->is_array()) throw GltfFault{fmt::format("{} is not an array", key)};
  indices.reserve(value->size());
  for (const GltfJson& element : *value) {
    const auto index = gltf_whole_value(element);
    if (!index) throw GltfFault{fmt::format("{} holds what is no whole number", key)};
    if (*index >= limit)
      throw GltfFault{fmt::format("{} names {}, of {} that there are", key, *index, limit)};
    indices.push_back(*index);
  }
  return indices;
}

namespace {

bool is_json_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::size_t after_json_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && is_json_blank(text[at])) ++at;
  return at;
}

// Returns the place after the closing quote of the string that begins at `at`.
std::size_t after_json_string(std::string_view text, std::size_t at) {
  // Strings of inline data are megabytes long, so this searches for the quote.
  for (std::size_t quote = text.find('"', at + 1); quote != text.npos;
       quote = text.find('"', quote + 1)) {
    std::size_t slashes = 0;
    while (text[quote - 1 - slashes] == '\\') ++slashes;
    if (slashes % 2 == 0) return quote + 1;
  }
  return text.size();
}

std::size_t after_json_brackets(std::string_view text, std::size_t at) {
  std::size_t depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = after_json_string(text, at);
      continue;
    }
    ++at;
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && --depth == 0) break;
  }
  return at;
}

std::size_t after_json_value(std::string_view text, std::size_t at) {
  if (at >= text.size()) return at;
  if (text[at] == '"') return after_json_string(text, at);
  if (text[at] == '{' || text[at] == '[') return after_json_brackets(text, at);
  const std::size_t end = text.find_first_of(",]} \t\r\n", at);
  return std::min(end, text.size());
}

bool is_json_key(std::string_view token, std::string_view key) {
  if (token.size() < 2) return false;
  if (token.find('\\') == token.npos) return token.substr(1, token.size() - 2) == key;
  const auto decoded = nlohmann::json::parse(token, nullptr, false);
  return decoded.is_string() && decoded.get_ref<const std::string&>() == key;
}

}  // namespace

ByteSpan json_root(std::string_view text) {
  const std::size_t begin = after_json_blanks(text, byte_order_mark_size(text));
  return {begin, after_json_value(text, begin) - begin};
}

std::optional<JsonMember> json_named_member(std::string_view text, ByteSpan object,
                                            std::string_view key) {
  std::optional<JsonMember> found;
  const std::size_t end = std::min(object.begin + object.size, text.size());
  if (object.size < 2 || text[object.begin] != '{') return found;
  std::size_t at = after_json_blanks(text, object.begin + 1);
  while (at < end && text[at] == '"') {
    const std::size_t key_end = after_json_string(text, at);
    const ByteSpan name{at, key_end - at};
    at = after_json_blanks(text, key_end);
    const std::size_t value = after_json_blanks(text, std::min(at + 1, end));
    const std::size_t value_end = after_json_value(text, value);
    if (is_json_key(text.substr(name.begin, name.size), key))
      found = JsonMember{name, {value, value_end - value}};
    at = after_json_blanks(text, value_end);
    if (at < end && text[at] == ',') at = after_json_blanks(text, at + 1);
  }
  return found;
}

std::optional<ByteSpan> json_member(std::string_view text, ByteSpan object, std::string_view key) {
  const auto found = json_named_member(text, object, key);
  if (!found) return std::nullopt;
  return found->value;
}

std::optional<ByteSpan> json_member(std::string_view text,
                                    std::initializer_list<const char*> keys) {
  std::optional<ByteSpan> place = json_root(text);
  for (const char* const key : keys) {
    if (place) place = json_member(text, *place, key);
  }
  return place;
}

std::vector<ByteSpan> json_elements(std::string_view text, ByteSpan array) {
  std::vector<ByteSpan> elements;
  const std::size_t end = std::min(array.begin + array.size, text.size());
  if (array.size < 2 || text[array.begin] != '[') return elements;
  std::size_t at = after_json_blanks(text, array.begin + 1);
  while (at + 1 < end) {
    const std::size_t value_end = after_json_value(text, at);
    if (value_end == at) break;
    elements.push_back({at, value_end - at});
    at = after_json_blanks(text, value_end);
    if (at < end && text[at] == ',') at = after_json_blanks(text, at + 1);
  }
  return elements;
}

std::optional<ByteSpan> json_element(std::string_view text, const char* key, std::size_t index) {
  const auto array = json_member(text, {key});
  if (!array) return std::nullopt;
  const auto elements = json_elements(text, *array);
  if (index >= elements.size()) return std::nullopt;
  return elements[index];
}

std::string without_inline_data(std::string_view text) {
  constexpr std::string_view mark = "\"data:";
  std::string out;
  std::size_t copied = 0, at = text.find(mark);
  while (at != text.npos) {
    const std::size_t last = at == 0 ? text.npos : text.find_last_not_of('\\', at - 1);
    const bool is_escaped = (at - 1 - last) % 2 == 1;  // the quote is part of another string
    const std::size_t end = is_escaped ? at + mark.size() : after_json_string(text, at);
    if (!is_escaped && text[end - 1] == '"') {
      out.append(text.substr(copied, at + mark.size() - copied));
      copied = end - 1;
    }
    at = text.find(mark, end);
  }
  return out.append(text.substr(copied));
}

std::string edited_json(std::string_view text, std::vector<JsonEdit> edits) {
  std::stable_sort(edits.begin(), edits.end(), [](const JsonEdit& a, const JsonEdit& b) {
    return a.place.begin < b.place.begin;
  });
  std::size_t size = text.size();
  for (const JsonEdit& edit : edits) size += edit.text.size();
  std::string out;
  out.reserve(size);
  std::size_t copied = 0;
  for (const JsonEdit& edit : edits) {
    out.append(text.substr(copied, edit.place.begin - copied));
    out.append(edit.text);
    copied = edit.place.begin + edit.place.size;
  }
  out.append(text.substr(copied));
  return out;
}

}  // namespace kinemend
