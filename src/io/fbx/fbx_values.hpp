// Reads the numbers, strings and arrays in the records of an FBX file, and the named properties of
// its objects.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/fbx/fbx_tree.hpp"
#include "kinemend/extend/rotation.hpp"

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

/// One line of Properties70 (`P`) or Properties60 (`Property`): a name, keywords, then values.
struct FbxNamedProperty {
  const FbxTree& tree;
  const FbxRecord& record;
  std::string_view name;
  std::size_t first_value;  ///< index of the first value

  const FbxProperty* value(std::size_t index) const {
    return tree.property(record, first_value + index);
  }
  std::optional<double> number(std::size_t index = 0) const {
    const FbxProperty* const found = value(index);
    return found == nullptr ? std::nullopt : fbx_number(tree, *found);
  }
  std::optional<std::int64_t> integer() const {
    const FbxProperty* const found = value(0);
    return found == nullptr ? std::nullopt : fbx_integer(tree, *found);
  }
  std::string_view text() const {
    const FbxProperty* const found = value(0);
    return found == nullptr ? std::string_view{} : fbx_text(tree, *found);
  }
  /// Returns three numbers; `otherwise` if they are not finite.
  Vec3 vector(Vec3 otherwise) const;
};

/// Calls `take(property)` for each property of an object (or of a template) in the file's order.
template <class Take>
void for_each_fbx_property(const FbxTree& tree, std::uint32_t object, Take&& take) {
  for (const std::string_view list : {"Properties70", "Properties60"}) {
    const std::uint32_t properties = tree.child(object, list);
    if (properties == no_fbx_record) continue;
    const std::size_t first_value = list == "Properties70" ? 4 : 3;
    for (std::uint32_t child = tree.records[properties].first_child; child != no_fbx_record;
         child = tree.records[child].next_sibling) {
      const FbxRecord& record = tree.records[child];
      const FbxProperty* const name = tree.property(record, 0);
      if (name != nullptr) take(FbxNamedProperty{tree, record, fbx_text(tree, *name), first_value});
    }
  }
}

}  // namespace kinemend
