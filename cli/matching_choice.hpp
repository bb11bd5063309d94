#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinemend::cli {

/// The choice that is meant: that of the very name, else the only one that differs from it in
/// capitals alone, else the name as it is.
std::string matching_choice(std::string_view name, const std::vector<std::string>& choices);

}  // namespace kinemend::cli
