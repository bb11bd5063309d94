// Paths and errors as the functions of Windows want and give them.
#pragma once

#include <filesystem>
#include <string>

namespace kinemend::platform {

/// A path that may be longer than 260 characters, also where Windows is not set up for long paths.
std::wstring long_path(const std::filesystem::path& path);
/// Puts the last error of Windows into `errno`. Returns false.
bool fail_with_last_error();

}  // namespace kinemend::platform
