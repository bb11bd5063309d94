// Reads the URIs of a glTF file's data: inline base64, or a separate file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kinemend {

/// Whether the URI itself contains the bytes.
bool is_data_uri(std::string_view uri);
/// Returns the base64 content of such a URI; empty if it is not base64 or is damaged.
std::optional<std::string> bytes_of_data_uri(std::string_view uri);
std::string base64_of(std::string_view bytes);

/// Returns the relative path of a URI, percent-decoded; empty for a URI outside the folder of the
/// file: absolute paths, schemes, drives, `..`.
std::optional<std::string> relative_path_of_uri(std::string_view uri);
/// Returns a file name as a URI: all characters except letters, digits and -._~ are
/// percent-encoded.
std::string uri_of_file_name(std::string_view name);

}  // namespace kinemend
