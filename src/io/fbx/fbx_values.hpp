// Reads the numbers, strings and arrays that the records of an FBX file hold.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

/// A number as a double or as an integer; none for another type, or a text that is no number.
std::optional<double> fbx_number(const FbxTree& tree, const FbxProperty& property);
std::optional<std::int64_t> fbx_integer(const FbxTree& tree, const FbxProperty& property);
/// A string, a word or a character as it stands in the file; empty for another type.
std::string_view fbx_text(const FbxTree& tree, const FbxProperty& property);
/// The first property of the first child of that name.
const FbxProperty* fbx_child_value(const FbxTree& tree, std::uint32_t record,
                                   std::string_view name);
std::int64_t fbx_child_integer(const FbxTree& tree, std::uint32_t record, std::string_view name,
                               std::int64_t otherwise);

/// `Hips` of `Model::Hips` (text) or `Hips\0\1Model` (binary), with the quotes that text escapes.
std::string fbx_object_name(const FbxTree& tree, const FbxProperty& property);

/// The property that holds the numbers of a record: its array, or in text that of its child `a`.
/// Null for a list of single numbers, or none.
const FbxProperty* fbx_array(const FbxTree& tree, const FbxRecord& record);

/// The bytes of an array of binary, unpacked, in the byte order of the file; of single precision
/// for `f`. Errors: `unreadable_input` for an unknown packing, damaged packed data, or a count that
/// the bytes cannot hold.
std::string fbx_unpacked(const FbxTree& tree, const FbxProperty& array);
/// Bytes packed by zlib.
std::string fbx_zlib(std::string_view raw);
/// The same bytes packed in the way of `array` (raw or zlib), as a property without its type code.
std::string fbx_packed(const FbxTree& tree, const FbxProperty& array, const std::string& raw);

/// How many numbers a record holds, without unpacking them: an upper bound in text.
std::size_t fbx_count(const FbxTree& tree, const FbxRecord& record);
/// All numbers of a record. Errors: the same, and for a value that is no number.
std::vector<double> fbx_numbers(const FbxTree& tree, const FbxRecord& record);
std::vector<std::int64_t> fbx_integers(const FbxTree& tree, const FbxRecord& record);

/// The places of the numbers in the text of an array (`A`).
struct FbxToken {
  std::size_t begin = 0;
  std::size_t end = 0;
};
std::vector<FbxToken> fbx_tokens(const FbxTree& tree, const FbxProperty& array);

}  // namespace kinemend
