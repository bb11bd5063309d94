// Reads fields of JSON objects with checks of their type, and finds the places of values in a JSON
// text, so that they can be replaced without changing the rest.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_document.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// An error in a field; it becomes an `Error` with a place once the element is known.
struct GltfFault {
  std::string message;
};

// Each function throws `GltfFault` for a value of another type, and for a missing value without
// default.
using GltfJson = nlohmann::json;

const GltfJson* gltf_field(const GltfJson& object, const char* key);
std::optional<std::size_t> gltf_whole(const GltfJson& object, const char* key);
std::size_t gltf_whole(const GltfJson& object, const char* key, std::size_t otherwise);
std::size_t gltf_needed_whole(const GltfJson& object, const char* key);
std::string gltf_text(const GltfJson& object, const char* key);
bool gltf_flag(const GltfJson& object, const char* key);
/// Returns an array of exactly `count` finite numbers; empty if the field is missing.
std::optional<std::vector<double>> gltf_numbers(const GltfJson& object, const char* key,
                                                std::size_t count);
/// Returns an array of indices below `limit`.
std::vector<std::size_t> gltf_indices(const GltfJson& object, const char* key, std::size_t limit);

// The functions below take a text that a parser has accepted; for any other text they return
// meaningless places within its bounds.

/// Returns the whole value of a text, without surrounding white space.
ByteSpan json_root(std::string_view text);
/// A member of an object: its name with the quotes, and its value.
struct JsonMember {
  ByteSpan key, value;

  /// Returns the span from the name to the end of the value.
  ByteSpan whole() const { return {key.begin, value.begin + value.size - key.begin}; }
};
/// Returns the member of that name in the object at `object`; the last if the name is repeated, as
/// in parsers. Empty if there is no such member or object.
std::optional<JsonMember> json_named_member(std::string_view text, ByteSpan object,
                                            std::string_view key);
/// Returns the value of that member.
std::optional<ByteSpan> json_member(std::string_view text, ByteSpan object, std::string_view key);
/// Returns the value at several nested keys, from the root.
std::optional<ByteSpan> json_member(std::string_view text, std::initializer_list<const char*> keys);
/// Returns the elements of the array at `array`; empty if the value is not an array.
std::vector<ByteSpan> json_elements(std::string_view text, ByteSpan array);
/// Returns element `index` of the array `key` of the root.
std::optional<ByteSpan> json_element(std::string_view text, const char* key, std::size_t index);

/// Returns the text with inline data (strings that begin with `data:`) cut to that word, so that no
/// parser reads the megabytes.
std::string without_inline_data(std::string_view text);

/// A replacement of a piece of text; size 0 inserts.
struct JsonEdit {
  ByteSpan place;
  std::string text;
};
/// Returns the text with all edits, which must not overlap. Edits at one place keep their order.
std::string edited_json(std::string_view text, std::vector<JsonEdit> edits);

}  // namespace kinemend
