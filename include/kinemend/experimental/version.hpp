// The version of the library.
#pragma once

#include <string_view>

namespace kinemend {

/// Returns the version as "1.2.3": major, minor and patch version.
std::string_view version() noexcept;

}  // namespace kinemend
