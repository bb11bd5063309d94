// Reads the numbers, strings and arrays in the records of an FBX file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

/// Returns a number as a double or as an integer; empty for another type, or a text that is not a
/// number.
std::optional<double> fbx_number(const FbxTree& tree, const FbxProperty& property);
std::optional<std::int64_t> fbx_integer(const FbxTree& tree, const FbxProperty& property);
/// Returns a string, a word or a character exactly as in the file; empty for another type.
std::string_view fbx_text(const FbxTree& tree, const FbxProperty& property);
/// Returns the first property of the first child of that name, or null.
const FbxProperty* fbx_child_value(const FbxTree& tree, std::uint32_t record,
                                   std::string_view name);
std::int64_t fbx_child_integer(const FbxTree& tree, std::uint32_t record, std::string_view name,
                               std::int64_t otherwise);

/// `Hips` of `Model::Hips` (text) or `Hips\0\1Model` (binary), with unescaped quotes.
std::string fbx_object_name(const FbxTree& tree, const FbxProperty& property);

/// Returns the property with the numbers of a record: its array, or in text the array of its child
/// `a`. Null for a list of single numbers, or without numbers.
const FbxProperty* fbx_array(const FbxTree& tree, const FbxRecord& record);

/// Returns the unpacked bytes of a binary array, in the byte order of the file; single precision
/// for `f`. Errors: `unreadable_input` for an unknown packing, damaged packed data, or a count that
/// the bytes cannot hold.
std::string fbx_unpacked(const FbxTree& tree, const FbxProperty& array);
/// Packs bytes with zlib.
std::string fbx_zlib(std::string_view raw);
/// Packs bytes in the same way as `array` (raw or zlib), as a property without its type code.
std::string fbx_packed(const FbxTree& tree, const FbxProperty& array, const std::string& raw);

/// Returns how many numbers a record holds, without unpacking them; an upper bound for text.
std::size_t fbx_count(const FbxTree& tree, const FbxRecord& record);
/// Returns all numbers of a record. Errors: as for `fbx_unpacked`, and for a value that is not a
/// number.
std::vector<double> fbx_numbers(const FbxTree& tree, const FbxRecord& record);
std::vector<std::int64_t> fbx_integers(const FbxTree& tree, const FbxRecord& record);

/// The places of the numbers in the text of an array (`A`).
struct FbxToken {
  std::size_t begin = 0;
  std::size_t end = 0;
};
std::vector<FbxToken> fbx_tokens(const FbxTree& tree, const FbxProperty& array);

}  // namespace kinemend
