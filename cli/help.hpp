// The help texts of the program and its commands, from the tables of flags.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"

namespace kinemend::cli {

/// `--version`: the version and the facts that a fault report should state.
std::string version_text();

/// `-h` of the program; `--help` adds exit codes and topics.
std::string program_help(bool is_long);
/// `-h`: one line per flag. `--help` adds details and examples. `group_help` covers the options of
/// methods and damages.
std::string command_help(const Command& command, bool is_long);

/// `kinemend help NAME` for a method, a damage or the like: its options in every command that has
/// it, with ranges and defaults, and its page. Empty if nothing has that name.
std::string group_help(std::string_view name);

/// Formats paragraphs, each after an empty line.
std::string description_text(const std::string& description);

/// Flags under one heading of the help.
struct FlagsOfGroup {
  std::string name;
  std::vector<const Flag*> flags;
};
/// The flags of a command by heading, each heading once, in the order of their first flags.
std::vector<FlagsOfGroup> flags_by_group(const Command& command);

/// "clean [OPTIONS] IN..."
std::string usage_line(const Command& command);
/// "-o, --output OUT"
std::string flag_names(const Flag& flag);
/// The line of a flag: help with range and default.
std::string flag_line(const Flag& flag);
/// How an option of a group is typed: "--cutoff-hz X", "--[no-]causal", or in a damage "std_deg=X".
std::string group_option_name(const Command& command, const OptionSpec& spec);
std::string group_option_line(const OptionSpec& spec);

struct ExitCode {
  int code;
  std::string meaning;
};
const std::vector<ExitCode>& exit_codes();

}  // namespace kinemend::cli
