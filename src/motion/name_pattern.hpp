#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Joints and markers as people name them.
namespace kinemend {

/// Capitals of ASCII made small.
std::string small_letters(std::string_view text);
/// Whether two names are the same but for the capitals of ASCII.
bool same_but_for_case(std::string_view a, std::string_view b);

/// N marks, 1 where a name is meant: it has that very name or matches the shell pattern, with or
/// without its subject. Where none does, capitals do not count. All are 0 where none is meant.
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::string& pattern);

/// N marks of all that the patterns mean; of all where there is no pattern. Errors:
/// `ErrorKind::usage` for a pattern that means none; `kind` ("joint", "marker") stands in it.
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::vector<std::string>& patterns,
                                      std::string_view kind);

}  // namespace kinemend
