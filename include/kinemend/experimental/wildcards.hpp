// Matches names with patterns of a shell.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// Whether a name matches a pattern with `*`, `?` and `[a-z]`, `[!a]`, `[[:digit:]]`; a backslash
/// escapes the next character. Works on bytes. Uses `fnmatch` of the system if it is glibc's.
bool matches_wildcards(const std::string& pattern, const std::string& name);

/// `matches_wildcards` without the system's `fnmatch`, on every system.
bool matches_wildcards_anywhere(std::string_view pattern, std::string_view name);

}  // namespace kinemend
