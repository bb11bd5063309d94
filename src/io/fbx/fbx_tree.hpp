// Holds the records of an FBX file, binary or text, with their offsets in the bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/portable.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

inline constexpr std::uint32_t no_fbx_record = 0xFFFFFFFF;

/// One value of a record. Binary: the type code of the file (Y C B I F D L of numbers, S R of
/// strings, f d l i b c of arrays). Text: N a number, W a bare word, S a string without its quotes,
/// * the count of an array, A all numbers of an array.
struct FbxProperty {
  std::size_t begin = 0;   ///< binary: after the type code
  std::uint32_t size = 0;  ///< bytes from there
  char type = 0;
};

/// A named record with properties and children. Places are bytes of the file.
struct FbxRecord {
  std::size_t begin = 0;             ///< offset of its header or name
  std::size_t end = 0;               ///< after its last byte
  std::size_t properties_begin = 0;  ///< offset of the list of properties
  std::size_t properties_end = 0;
  std::uint32_t first_property = 0;  ///< in `FbxTree::properties`
  std::uint32_t property_count = 0;
  std::uint32_t parent = no_fbx_record;
  std::uint32_t first_child = no_fbx_record;
  std::uint32_t next_sibling = no_fbx_record;
  std::uint32_t name_begin = 0;  ///< bytes after `begin`
  std::uint32_t name_size = 0;
};

/// An FBX file as it was read: its bytes, and the places of its records. Parents precede children.
struct FbxTree {
  std::string name;  ///< for messages
  std::string bytes;
  std::uint32_t version = 0;  ///< 7400
  bool is_text = false;
  bool is_big_endian = false;
  std::size_t records_end = 0;  ///< binary: after the record that ends the top level
  std::uint32_t first_root = no_fbx_record;
  std::vector<FbxRecord> records;
  std::vector<FbxProperty> properties;

  bool has_wide_headers() const { return version >= 7500; }
  std::string_view name_of(const FbxRecord& record) const {
    return std::string_view(bytes).substr(record.begin + record.name_begin, record.name_size);
  }
  std::string_view text_of(const FbxProperty& property) const {
    return std::string_view(bytes).substr(property.begin, property.size);
  }
  const FbxProperty* property(const FbxRecord& record, std::size_t index) const {
    return index < record.property_count ? &properties[record.first_property + index] : nullptr;
  }
  /// The first child of that name, or `no_fbx_record` if the record has no such child. With
  /// `no_fbx_record` as the parent it searches the top level.
  std::uint32_t child(std::uint32_t parent, std::string_view child_name) const;
  /// Calls `visit` with each child of a record, if there is one.
  template <class Visit>
  void for_each_child(std::uint32_t parent, Visit&& visit) const {
    if (parent == no_fbx_record) return;
    for (std::uint32_t child = records[parent].first_child; child != no_fbx_record;
         child = records[child].next_sibling)
      visit(child);
  }
  /// Returns an error with the byte, or with the line of a text.
  Error error_at(std::size_t place, std::string_view message) const;
};

/// Returns the bytes of one number by its type code, for properties and arrays; 0 for another code.
std::size_t fbx_number_bytes(char type);

/// The head of a packed array in a binary file.
struct FbxArrayHead {
  std::size_t count = 0;
  std::uint32_t packing = 0;  ///< 0 none, 1 zlib
  std::size_t packed_bytes = 0;
};
inline constexpr std::size_t fbx_array_head_bytes = 12;
/// Reads the head at `place`; all its bytes must be in the file.
FbxArrayHead fbx_array_head(const FbxTree& tree, std::size_t place);

/// Reads the records of any FBX file, version 3 to 8. `max_depth`: deeper nesting is an error.
/// Errors: `unreadable_input` with the byte or the line.
FbxTree read_fbx_tree(std::string bytes, std::string_view name, std::size_t max_depth);

/// Whether the bytes begin as a binary FBX file.
bool is_binary_fbx(std::string_view bytes);

inline float fbx_float(const char* bytes, bool big_endian) {
  return bits_as<float>(read_word<std::uint32_t>(bytes, big_endian));
}
inline double fbx_double(const char* bytes, bool big_endian) {
  return bits_as<double>(read_word<std::uint64_t>(bytes, big_endian));
}

}  // namespace kinemend
