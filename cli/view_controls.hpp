// The controls of the page of `view`: what they may set, with the help, ranges and defaults of the
// command line.
#pragma once

#include <string>

#include "json.hpp"
#include "kinemend/take.hpp"
#include "view_asked.hpp"

namespace kinemend::cli {

/// Flags of `clean` and `fill`, methods with their options, and presets, as web/src/served.ts reads
/// them.
Json view_controls();
/// Why methods cannot clean this take, by name; those that can are not listed.
Json why_not_methods(const Take& take);
/// Refuses a flag that the page may not set: none that reads or writes a file. Errors:
/// `ErrorKind::usage`.
void check_view_flag(const ViewAsked& asked, const std::string& name);

}  // namespace kinemend::cli
