// Reads the whole content of a file or of standard input.
#pragma once

#include <filesystem>
#include <string>

namespace kinemend {

/// The whole content of a file, or of standard input for "-". Errors: `unreadable_input`.
std::string file_bytes(const std::filesystem::path& path);

}  // namespace kinemend
