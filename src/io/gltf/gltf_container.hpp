// Splits a glTF file into its JSON text and its binary chunk, joins them again, and reads the URIs
// of other data: inline base64, or a separate file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/motion/motion_document.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// A glTF file as it was read: `.glb`, or JSON text.
struct GltfFile {
  std::string name;  ///< for messages, and to find files beside it
  std::string bytes;
  bool is_binary = false;  ///< a `.glb`
  ByteSpan json;
  std::optional<ByteSpan> binary;  ///< the content of the chunk BIN

  std::string_view json_text() const {
    return std::string_view(bytes).substr(json.begin, json.size);
  }
};

/// Finds the parts. Repair: `bytes_after_end`, for bytes after the end stated by the header.
/// Errors: `unreadable_input` with the byte for a container that is cut, has a version other than
/// 2, or has no JSON.
GltfFile open_gltf(std::string bytes, std::string_view name, bool strict, Diagnostics& diagnostics);

/// Returns an error about an element of an array of the root (for example `accessors`, 3), with the
/// byte of the element.
Error gltf_error(const GltfFile& file, const char* section, std::size_t index,
                 std::string_view message);

/// Returns the file with a new JSON text and a new binary chunk (null: the existing chunk). Other
/// chunks keep their bytes. Errors: `usage` for a file above 4 GiB.
std::string reassembled_gltf(const GltfFile& file, std::string json,
                             const std::string* binary = nullptr);
/// Returns a new binary file of JSON and one binary chunk, which is left out if empty.
std::string new_glb(std::string_view json, std::string_view binary);

/// Whether the URI itself contains the bytes.
bool is_data_uri(std::string_view uri);
/// Returns the base64 content of such a URI; empty if it is not base64 or is damaged.
std::optional<std::string> bytes_of_data_uri(std::string_view uri);

/// Returns the relative path of a URI, percent-decoded; empty for a URI outside the folder of the
/// file: absolute paths, schemes, drives, `..`.
std::optional<std::string> relative_path_of_uri(std::string_view uri);
/// Returns a file name as a URI: all characters except letters, digits and -._~ are
/// percent-encoded.
std::string uri_of_file_name(std::string_view name);

}  // namespace kinemend
