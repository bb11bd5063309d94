#pragma once

#include <filesystem>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// The ASF file of an AMC, as `ReadOptions::skeleton` describes. `amc_name` is its path or
/// "standard input", `named_inside` what its line `#!OML:ASF` says. Errors: `unreadable_input`,
/// with the names that were tried.
std::filesystem::path find_skeleton_file(std::string_view amc_name, std::string_view named_inside,
                                         const ReadOptions& options);

}  // namespace kinemend
