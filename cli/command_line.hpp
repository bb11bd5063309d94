// Parses command lines by the tables of commands and flags.
#pragma once

#include <string>
#include <vector>

#include "command.hpp"

namespace kinemend::cli {

/// A parsed command line.
struct Request {
  enum class Kind { run, short_help, long_help, version };
  Kind kind = Kind::run;
  Arguments arguments;  ///< `command` is null for the program's own help and version
};

/// Parses the words after the program's name. Errors: `ErrorKind::usage`.
Request parse_command_line(const std::vector<std::string>& words);

/// The text of a flag as a value of its type. Errors name the flag as it is typed.
OptionValue parse_flag_value(const OptionSpec& spec, const std::string& text);

/// `a,b` and `c` to `a`, `b`, `c`; empty parts are skipped.
std::vector<std::string> split_list(const std::vector<std::string>& texts);

}  // namespace kinemend::cli
