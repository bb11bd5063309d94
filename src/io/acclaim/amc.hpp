// The format AMC: recognises, reads and writes motion that belongs to an ASF skeleton.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// How likely the head of a file is AMC, 0 to 100.
int sniff_amc(std::string_view head);
/// Reads AMC with the ASF that `ReadOptions::skeleton` describes. Errors: `unreadable_input`,
/// naming the line, or the skeletons that were looked for.
TakeResult read_amc(std::string bytes, std::string_view name, const ReadOptions& options);
/// The same with the skeleton's bytes; `asf_name` stands in messages.
TakeResult read_amc(std::string bytes, std::string_view name, std::string asf_bytes,
                    std::string_view asf_name, const ReadOptions& options);
/// A clip read from AMC comes out in its source's layout, with the digits of every sample that has
/// not changed; any other in a plain layout that fits what `write_asf` writes. Errors: `usage` when
/// the format cannot hold the clip.
std::string write_amc(const Take& clip);

/// `side_file` of an AMC.
std::optional<SideFile> amc_side_file(const Take& take, std::string_view bytes,
                                      const std::filesystem::path& output);

}  // namespace kinemend
