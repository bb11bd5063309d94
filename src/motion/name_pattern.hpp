// Selects joints and markers by names and shell patterns.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// N marks, 1 where a name equals the given one or matches the shell pattern, with or without its
/// subject. Where none does, case is ignored. All are 0 without a match.
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::string& pattern);

/// N marks of all matches of the patterns; of all names where there is no pattern. Errors:
/// `ErrorKind::usage` for a pattern without a match, which states `kind` ("joint", "marker").
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::vector<std::string>& patterns,
                                      std::string_view kind);

}  // namespace kinemend
