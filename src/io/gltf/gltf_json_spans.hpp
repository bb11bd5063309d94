// Finds where the values of a JSON text stand, so that they can be replaced without touching the
// rest.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_document.hpp"

namespace kinemend {

// All functions take a text that a parser has accepted; of any other text they return nonsense
// within its bounds.

/// The whole value of a text, without white space around it.
ByteSpan json_root(std::string_view text);
/// A member of an object: its name with the quotes, and its value.
struct JsonMember {
  ByteSpan key, value;

  /// From the name to the end of the value.
  ByteSpan whole() const { return {key.begin, value.begin + value.size - key.begin}; }
};
/// The member of that name of the object at `object`; of members of one name the last, as parsers
/// take it. None where there is no such member, or no object.
std::optional<JsonMember> json_named_member(std::string_view text, ByteSpan object,
                                            std::string_view key);
/// Its value.
std::optional<ByteSpan> json_member(std::string_view text, ByteSpan object, std::string_view key);
/// The same from the root, along several keys.
std::optional<ByteSpan> json_member(std::string_view text, std::initializer_list<const char*> keys);
/// The elements of the array at `array`. Empty if the value there is not an array.
std::vector<ByteSpan> json_elements(std::string_view text, ByteSpan array);
/// The element `index` of the array `key` of the root.
std::optional<ByteSpan> json_element(std::string_view text, const char* key, std::size_t index);

/// The text with inline data (strings that begin with `data:`) cut to that word: megabytes that no
/// parser has to look at.
std::string without_inline_data(std::string_view text);

/// A piece of a text that is replaced; of size 0: inserted.
struct JsonEdit {
  ByteSpan place;
  std::string text;
};
/// The text with all edits, which do not overlap. Edits at one place keep their order.
std::string edited_json(std::string_view text, std::vector<JsonEdit> edits);

}  // namespace kinemend
