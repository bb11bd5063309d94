// The version of the library.
#pragma once

#include <string_view>

namespace kinemend {

/// "0.1.0"
std::string_view version() noexcept;

}  // namespace kinemend
