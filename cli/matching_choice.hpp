// Finds the choice that a typed name means, in any case.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinemend::cli {

/// The choice with exactly this name, or the only one that matches it ignoring case, or the name
/// unchanged.
std::string matching_choice(std::string_view name, const std::vector<std::string>& choices);

}  // namespace kinemend::cli
