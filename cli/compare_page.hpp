// Makes the page of a comparison, for `compare` and for `view`.
#pragma once

#include <string>

#include "command.hpp"

namespace kinemend::cli {

/// The page of `compare`, as --report FILE.html writes it, for a checked command line. Throws the
/// errors of reading and comparing.
std::string comparison_page(const Arguments& arguments, bool is_served);

}  // namespace kinemend::cli
