#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "kinemend/cleaner.hpp"

namespace kinemend::cli {

/// The table of methods as groups of flags.
std::vector<OptionGroup> method_groups();
std::vector<std::string> method_names();
/// nullptr when there is none.
const Method* method_called(std::string_view name);

/// Texts of method options from the command line, as values of this method. Errors:
/// `ErrorKind::usage` for an option of another method or a value out of range.
OptionValues parse_method_options(const Method& method,
                                  const std::map<std::string, std::string, std::less<>>& texts);

}  // namespace kinemend::cli
