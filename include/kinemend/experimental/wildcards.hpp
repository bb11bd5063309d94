// Matches names with patterns of a shell.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// Whether a name fits a pattern with `*`, `?` and `[a-z]`, `[!a]`, `[[:digit:]]`; a backslash
/// takes the next character for itself. Works on bytes. A system's own `fnmatch` is used where it
/// is the one of glibc.
bool matches_wildcards(const std::string& pattern, const std::string& name);

/// The same by code of the project, on every system.
bool matches_wildcards_anywhere(std::string_view pattern, std::string_view name);

}  // namespace kinemend
