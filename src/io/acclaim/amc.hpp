// The format AMC: recognises, reads and writes motion that belongs to an ASF skeleton.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// Returns how likely the head of a file is AMC, 0 to 100.
int sniff_amc(std::string_view head);
/// Reads AMC with the ASF that `ReadOptions::skeleton` describes. Errors: `unreadable_input`,
/// naming the line, or the skeleton files that were tried.
TakeResult read_amc(std::string bytes, std::string_view name, const ReadOptions& options);
/// Reads AMC with the skeleton's bytes; `asf_name` appears in messages.
TakeResult read_amc(std::string bytes, std::string_view name, std::string asf_bytes,
                    std::string_view asf_name, const ReadOptions& options);
/// Writes a clip. A clip read from AMC keeps its source's layout and the digits of every unchanged
/// sample; any other clip gets a plain layout that fits the output of `write_asf`. Errors: `usage`
/// if the format cannot hold the clip.
std::string write_amc(const Take& clip);

/// Returns `side_file` of an AMC.
std::optional<SideFile> amc_side_file(const Take& take, std::string_view bytes,
                                      const std::filesystem::path& output);

}  // namespace kinemend
