// The tables behind the parser, help, manual page, shell completion and configuration files.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/options.hpp"

namespace kinemend::cli {

/// How often a flag takes a value.
enum class Takes : std::uint8_t {
  nothing,  ///< a switch
  value,    ///< one value; the last one given is used
  list,     ///< comma-separated values; may be given several times
  repeated  ///< one value; may be given several times
};

/// The kind of value that shells complete, after the choices of the flag's spec.
enum class Completion : std::uint8_t { none, file, folder };

/// One flag of a command, defined once. Its spec holds name (`max_change_deg` is
/// `--max-change-deg`), unit, default, range, choices and the one-line help.
struct Flag {
  OptionSpec spec;
  Takes takes = Takes::value;
  char letter = 0;         ///< `-o`; 0 for none
  std::string value_name;  ///< "FILE"; empty: derived from the spec
  std::string group;       ///< heading in the help
  std::string details;     ///< more sentences for the long help
  Completion completion = Completion::none;
  bool configurable = false;  ///< allowed in a configuration file
  /// Earlier spellings, which scripts may use; the parser accepts them, and the help omits them.
  std::vector<std::string> older_names{};
  bool has_default = true;  ///< false: no default is shown and none applies
  /// The choices that help and shells list; empty: all. The command refuses the other ones with a
  /// reason.
  std::vector<std::string> offered;
};

struct Positional {
  std::string name;  ///< "IN"
  std::string help;
  std::size_t minimum = 1;
  std::size_t maximum = 1;
  std::vector<std::string> choices;  ///< for shells and parser; empty: files
};

/// The options of an entry of a library table, that is, of a method or a damage.
struct OptionGroup {
  std::string name;     ///< "bilateral"
  std::string summary;  ///< one line
  std::string paper;
  std::vector<OptionSpec> options;
};

struct Example {
  std::string command;
  std::string explanation;
};

class Arguments;

struct Command {
  std::string name;
  std::string summary;      ///< one line
  std::string description;  ///< paragraphs, separated by blank lines
  std::vector<Positional> positionals;
  std::vector<Flag> flags;
  std::string group_heading;        ///< "Options of --method %"
  std::vector<OptionGroup> groups;  ///< options of the entries of a table
  bool groups_are_flags = false;    ///< each option of a group is a separate flag
  std::vector<Example> examples;
  int (*run)(const Arguments& arguments) = nullptr;
};

/// Every command, in the order of the help.
const std::vector<Command>& commands();
const Command* find_command(std::string_view name);

/// A checked command line.
class Arguments {
 public:
  const Command* command = nullptr;
  std::vector<std::string> words;  ///< all words as given
  std::vector<std::string> positionals;
  OptionValues values;  ///< given flags with one value
  std::map<std::string, std::vector<std::string>, std::less<>> lists;  ///< given lists
  std::map<std::string, std::string, std::less<>> group_texts;         ///< given flags of groups

  bool given(std::string_view name) const {
    return values.find(name) != values.end() || lists.find(name) != lists.end();
  }
  /// Returns the given value or the default.
  double number(std::string_view name) const { return std::get<double>(value(name)); }
  std::int64_t whole(std::string_view name) const { return std::get<std::int64_t>(value(name)); }
  bool flag(std::string_view name) const { return std::get<bool>(value(name)); }
  std::string text(std::string_view name) const { return std::get<std::string>(value(name)); }
  std::vector<std::string> list(std::string_view name) const;

 private:
  OptionValue value(std::string_view name) const;
};

/// Makes flags for the tables.
Flag switch_flag(std::string name, std::string group, std::string help, std::string details = {});
Flag number_flag(std::string name, std::string unit, double default_value, double minimum,
                 double maximum, std::string group, std::string help, std::string details = {});
Flag whole_flag(std::string name, std::int64_t default_value, double minimum, double maximum,
                std::string group, std::string help, std::string details = {});
Flag text_flag(std::string name, std::string value_name, std::string group, std::string help,
               std::string details = {});
/// Its value is a path, which shells complete.
Flag file_flag(std::string name, std::string value_name, std::string group, std::string help,
               std::string details = {}, Completion completion = Completion::file);
/// Its value is one of `choices`. An empty `default_choice` means that it has no default.
Flag choice_flag(std::string name, std::string group, std::string help,
                 std::vector<std::string> choices, std::string default_choice = {},
                 std::string details = {});
/// Returns the flag with no default, so that `Arguments::given` decides whether it applies.
Flag without_default(Flag flag);

/// Returns whether a switch is on unless `--no-...` turns it off.
bool is_on_by_default(const Flag& flag);
/// Returns whether an option of a group names a file: its text has no fixed choices.
bool names_file(const OptionSpec& spec);
/// Quotes a text for a shell: 'it'\''s'.
std::string single_quoted(std::string_view text);
/// A word as it is typed in a shell, in quotes only if it needs them.
std::string shell_word(std::string_view word);
/// The words of a command line, as typed in a shell: "kinemend clean walk.bvh".
std::string shell_line(const std::vector<std::string>& words);
/// `max_change_deg` to `max-change-deg`.
std::string dashed(std::string_view name);
/// The placeholder of a value in the help: "FILE", "X", "N", "a|b".
std::string value_name(const Flag& flag);
/// "0 to 180 deg; default 180"; empty if there is neither range nor default.
std::string range_text(const OptionSpec& spec, bool has_default = true);

}  // namespace kinemend::cli
