// Converts paths and errors for the functions of Windows.
#pragma once

#include <filesystem>
#include <string>

namespace kinemend::platform {

/// A path that may be longer than 260 characters, even if Windows is not set up for long paths.
std::wstring long_path(const std::filesystem::path& path);
/// Sets `errno` from the last error of Windows. Returns false.
bool fail_with_last_error();

}  // namespace kinemend::platform
