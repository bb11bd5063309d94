// The options of cleaning methods as flags of a command.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::cli {

/// The method used if none is named. The page of `view` gets it from the program together with the
/// defaults of all flags.
inline constexpr std::string_view default_method = "learned";

/// The table of methods as groups of flags.
std::vector<OptionGroup> method_groups();
std::vector<std::string> method_names();
/// Returns nullptr for an unknown name.
const Method* method_called(std::string_view name);

/// Texts of group options from the command line, as values of the group called `chosen`. Errors:
/// `ErrorKind::usage` for an option of other groups (`hint` ends the message) or a value out of
/// range.
OptionValues parse_group_options(const std::vector<OptionGroup>& groups, std::string_view chosen,
                                 const std::map<std::string, std::string, std::less<>>& texts,
                                 std::string_view hint = "");
/// Parses the options of a cleaning method.
OptionValues parse_method_options(const Method& method,
                                  const std::map<std::string, std::string, std::less<>>& texts);

/// The files named by these values: models and maps.
std::vector<std::string> option_files(const Method& method, const OptionValues& values);

}  // namespace kinemend::cli
