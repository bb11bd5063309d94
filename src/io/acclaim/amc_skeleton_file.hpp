// Finds the ASF file that belongs to an AMC file, and names one for an output.
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

/// Under which name the skeleton `asf_bytes` is to stand beside the AMC file `output`, so that
/// `find_skeleton_file` finds it there; empty where it does already. `usual_name`: what the
/// skeleton was called so far, which is kept where it can be.
std::filesystem::path skeleton_place(const std::filesystem::path& output,
                                     std::string_view named_inside, std::string_view asf_bytes,
                                     const std::string& usual_name);

}  // namespace kinemend
