// Reads the addresses by which a glTF file names its data: inline base64, or a file beside it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kinemend {

/// Whether the bytes stand in the address itself.
bool is_data_uri(std::string_view uri);
/// The base64 content of such an address; none where it is not base64 or is damaged.
std::optional<std::string> bytes_of_data_uri(std::string_view uri);
std::string base64_of(std::string_view bytes);

/// The relative path that an address names, percent-decoded; none for an address that leaves the
/// folder of the file or names another place: absolute paths, schemes, drives, `..`.
std::optional<std::string> relative_path_of_uri(std::string_view uri);
/// A file name as an address: everything but letters, digits and -._~ percent-encoded.
std::string uri_of_file_name(std::string_view name);

}  // namespace kinemend
