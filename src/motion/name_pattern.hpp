// Selects joints and markers by names and shell patterns.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// Returns N marks, 1 if a name equals the given one or matches the shell pattern, with or without
/// its subject. If no name matches, case is ignored. All are 0 without a match.
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::string& pattern);

/// Returns N marks of all matches of the patterns, or of all names if there is no pattern. Errors:
/// `ErrorKind::usage` for a pattern without a match, which states `kind` ("joint", "marker").
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::vector<std::string>& patterns,
                                      std::string_view kind);

}  // namespace kinemend
