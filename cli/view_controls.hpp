// The controls of the `view` page: their settings, with the help, ranges and defaults of the
// command line.
#pragma once

#include <string>

#include "json.hpp"
#include "kinemend/take.hpp"
#include "view_asked.hpp"

namespace kinemend::cli {

/// Flags of `clean` and `fill`, methods with their options, and presets, in the form that
/// web/src/served.ts reads.
Json view_controls();
/// Why each method cannot clean this take, by name; suitable methods are not listed.
Json why_not_methods(const Take& take);
/// Refuses a flag that the page may not set, such as one that reads or writes a file. Errors:
/// `ErrorKind::usage`.
void check_view_flag(const ViewAsked& asked, const std::string& name);

}  // namespace kinemend::cli
