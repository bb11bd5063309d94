#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"

namespace kinemend::cli {

/// `-h` of the program and `--help`, which adds the exit codes.
std::string program_help(bool is_long);
/// `-h`: a line a flag. `--help`: with details, the options of every method or damage, examples.
std::string command_help(const Command& command, bool is_long);

/// What `kinemend help NAME` prints of a method, a damage or the like: its options in every command
/// that has it. Empty where there is none of that name.
std::string group_help(std::string_view name);

/// Paragraphs, each behind an empty line.
std::string description_text(const std::string& description);

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
