// Finds the ASF file that belongs to an AMC file, and names one for an output.
#pragma once

#include <filesystem>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// Finds the ASF file of an AMC, as `ReadOptions::skeleton` describes. `amc_name` is the AMC's path
/// or "standard input", `named_inside` the path in its line `#!OML:ASF`. Errors:
/// `unreadable_input`, with the names that were tried.
std::filesystem::path find_skeleton_file(std::string_view amc_name, std::string_view named_inside,
                                         const ReadOptions& options);

/// Returns the path at which the skeleton `asf_bytes` must be written beside the AMC file `output`,
/// so that `find_skeleton_file` finds it; empty if it finds it already. `usual_name`: the current
/// name of the skeleton, which is kept if possible.
std::filesystem::path skeleton_place(const std::filesystem::path& output,
                                     std::string_view named_inside, std::string_view asf_bytes,
                                     const std::string& usual_name);

}  // namespace kinemend
