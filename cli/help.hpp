#pragma once

#include <string>

#include "command.hpp"

namespace kinemend::cli {

/// `-h` of the program and `--help`, which adds the exit codes.
std::string program_help(bool is_long);
/// `-h`: a line a flag. `--help`: with details, the options of every method or damage, examples.
std::string command_help(const Command& command, bool is_long);

/// "clean [OPTIONS] IN..."
std::string usage_line(const Command& command);
/// "-o, --output OUT"
std::string flag_names(const Flag& flag);
/// The line of a flag: help with range and default.
std::string flag_line(const Flag& flag);
/// How an option of a group is typed: "--cutoff-hz X", "--[no-]causal" or, in a damage,
/// "std_deg=X".
std::string group_option_name(const Command& command, const OptionSpec& spec);
std::string group_option_line(const OptionSpec& spec);

struct ExitCode {
  int code;
  std::string meaning;
};
const std::vector<ExitCode>& exit_codes();

}  // namespace kinemend::cli
