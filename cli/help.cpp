// Lays out the flags, groups of options, exit codes and examples of each command as text.
#include "help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "platform/console.hpp"
#include "terminal.hpp"
#include "topics.hpp"

namespace kinemend::cli {

namespace {

// Columns of a line, chosen by hand.
constexpr std::size_t help_column = 30, text_width = 100;

/// Puts a name and its text side by side, or the text below a long name.
std::string entry(std::string_view name, std::string_view text, std::size_t column = help_column) {
  std::string line = fmt::format("  {}", name);
  const std::size_t width = display_width(line);
  if (width + 2 > column) return line + "\n" + wrap(text, column, text_width);
  return line + std::string(column - width, ' ') + wrap(text, column, text_width, true);
}

std::string heading(std::string_view text) {
  return fmt::format("\n{}\n", Colours::of_out().paint(Paint::bold, fmt::format("{}:", text)));
}

/// Returns whether a flag's values are the names of groups, which the help lists separately.
bool names_groups(const Command& command, const Flag& flag) {
  return !command.groups.empty() &&
         std::all_of(command.groups.begin(), command.groups.end(), [&](const OptionGroup& group) {
           const std::vector<std::string>& choices = flag.spec.choices;
           return std::find(choices.begin(), choices.end(), group.name) != choices.end();
         });
}

std::string flag_text(const Command& command, const Flag& flag, bool is_long) {
  Flag shown = flag;
  if (names_groups(command, flag)) {
    if (shown.value_name.empty()) shown.value_name = "NAME";
    shown.spec.choices.clear();
    shown.offered.clear();
  }
  const std::string line = flag_line(shown);
  return entry(flag_names(shown),
               is_long && !flag.details.empty() ? fmt::format("{}. {}", line, flag.details) : line);
}

std::string flags_text(const Command& command, bool is_long) {
  std::string text;
  for (const auto& [group, flags] : flags_by_group(command)) {
    text += heading(group);
    for (const Flag* flag : flags) text += flag_text(command, *flag, is_long);
  }
  text += heading("Help");
  text += entry("-h, --help", "-h prints this list, --help adds details and examples");
  return text;
}

/// Uses one line if the example fits.
std::string example_text(const Example& example) {
  const std::string line = fmt::format("  {}  # {}", example.command, example.explanation);
  if (display_width(line) <= text_width) return line + "\n";
  return fmt::format("  {}\n{}", example.command, wrap(example.explanation, 6));
}

std::string group_title(const Command& command, std::string_view name) {
  std::string title = command.group_heading;
  return title.replace(title.find('%'), 1, name);
}

std::string group_text(const Command& command, const OptionGroup& group) {
  std::string text = wrap(fmt::format("{} {}", group.summary,
                                      group.paper.empty() ? "" : fmt::format("({})", group.paper)),
                          2);
  for (const OptionSpec& spec : group.options)
    text += entry(group_option_name(command, spec), group_option_line(spec));
  return text;
}

/// The names of the groups, whose options `kinemend help NAME` lists.
std::string group_names_text(const Command& command, bool is_long) {
  if (command.groups.empty()) return "";
  std::string text = heading(group_title(command, "NAME"));
  if (is_long) {
    std::vector<std::string> names;
    for (const OptionGroup& group : command.groups) names.push_back(group.name);
    text += wrap(fmt::format("{}.", fmt::join(names, ", ")), 2);
  } else {
    for (const OptionGroup& group : command.groups) text += entry(group.name, group.summary, 18);
  }
  return text + wrap(fmt::format("To see what one does, and its options with ranges and defaults, "
                                 "type: kinemend help {}",
                                 command.groups.front().name),
                     2);
}

/// The commands whose groups of this name have the same title and options, without "kinemend".
std::string commands_of_group(const Command& first, const OptionGroup& group) {
  std::vector<std::string> names;
  for (const Command& command : commands()) {
    const bool is_alike =
        command.group_heading == first.group_heading &&
        std::any_of(command.groups.begin(), command.groups.end(), [&](const OptionGroup& other) {
          return other.name == group.name && other.options.size() == group.options.size();
        });
    if (is_alike) names.push_back(command.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns the page of the documentation about a group of a command; empty if it has no page.
std::string page_of_group(const Command& command, std::string_view group) {
  if (command.name == "fill") return "docs/methods/fill.md";
  if (command.name == "train") return "docs/models.md";
  if (command.name == "corrupt") return "docs/cli.md";
  return fmt::format("docs/methods/{}.md", group);
}

}  // namespace

std::string description_text(const std::string& description) {
  std::string text;
  std::size_t begin = 0;
  while (begin < description.size()) {
    const std::size_t end = std::min(description.find("\n\n", begin), description.size());
    text += '\n';
    text += wrap(description.substr(begin, end - begin), 0, text_width);
    begin = end + 2;
  }
  return text;
}

std::vector<FlagsOfGroup> flags_by_group(const Command& command) {
  std::vector<FlagsOfGroup> groups;
  for (const Flag& flag : command.flags) {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const FlagsOfGroup& known) { return known.name == flag.group; });
    if (group == groups.end()) group = groups.insert(group, {flag.group, {}});
    group->flags.push_back(&flag);
  }
  return groups;
}

const std::vector<ExitCode>& exit_codes() {
  static const std::vector<ExitCode> codes = {
      {0, "done"},
      {1, "a quality limit was exceeded, or --strict found something to repair or to warn about"},
      {2, "the command line or a configuration file is wrong"},
      {3, "an input cannot be read"},
      {4, "an output cannot be written, or it exists and --force is not given"}};
  return codes;
}

std::string usage_line(const Command& command) {
  std::string line = command.name + " [OPTIONS]";
  for (const Positional& positional : command.positionals) {
    const std::string many = positional.maximum > 1 ? "..." : "";
    line += positional.minimum == 0 ? fmt::format(" [{}{}]", positional.name, many)
                                    : fmt::format(" {}{}", positional.name, many);
  }
  return line;
}

std::string flag_names(const Flag& flag) {
  const std::string value = value_name(flag);
  return fmt::format("{}--{}{}{}{}", flag.letter ? fmt::format("-{}, ", flag.letter) : "    ",
                     is_on_by_default(flag) ? "[no-]" : "", dashed(flag.spec.name),
                     value.empty() ? "" : " ", value);
}

std::string flag_line(const Flag& flag) {
  if (flag.takes == Takes::nothing) return flag.spec.help;
  // A value without a name is shown by its choices, which are not repeated here.
  OptionSpec spec = flag.spec;
  if (!flag.offered.empty()) spec.choices = flag.offered;
  if (flag.value_name.empty()) spec.choices.clear();
  const std::string range = range_text(spec, flag.has_default);
  return range.empty() ? spec.help : fmt::format("{} ({})", spec.help, range);
}

std::string group_option_name(const Command& command, const OptionSpec& spec) {
  const bool is_flag = std::holds_alternative<bool>(spec.default_value);
  Flag flag;
  flag.spec = spec;
  if (!spec.choices.empty()) flag.value_name = "NAME";
  if (command.groups_are_flags && names_file(spec)) flag.value_name = "FILE";
  const std::string value = value_name(flag);
  if (!command.groups_are_flags)
    return fmt::format("  {}={}", spec.name, is_flag ? "true|false" : value);
  if (is_flag) return fmt::format("    --[no-]{}", dashed(spec.name));
  return fmt::format("    --{} {}", dashed(spec.name), value);
}

std::string group_option_line(const OptionSpec& spec) {
  const std::string range = range_text(spec);
  return range.empty() ? spec.help : fmt::format("{} ({})", spec.help, range);
}

std::string version_text() {
#if defined(__clang__)
  const std::string compiler =
      fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  const std::string compiler =
      fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
  const platform::SystemNames names = platform::system_names();
  std::vector<std::string_view> models;
  for (const ShippedModel& model : shipped_models()) models.push_back(model.method);
  return fmt::format(
      "kinemend {}\n"
      "built with {}, running on {} {}\n"
      "learned models: {}\n"
      "licence: Apache 2.0\n",
      version(), compiler, names.system.empty() ? "an unknown system" : names.system, names.machine,
      models.empty() ? "none" : fmt::format("{}", fmt::join(models, ", ")));
}

std::string program_help(bool is_long) {
  std::string text = fmt::format(
      "kinemend {}: cleans human motion capture\n\nUsage: kinemend COMMAND [OPTIONS] ...\n",
      version());
  text += heading("Commands");
  for (const Command& command : commands()) text += entry(command.name, command.summary, 17);
  text += heading("Options");
  text += entry("-h, --help", "-h prints this list, --help adds exit codes and topics", 17);
  text += entry("-V, --version", "print the version", 17);
  if (is_long) {
    text += heading("Exit codes");
    for (const ExitCode& code : exit_codes())
      text += entry(fmt::format("{}", code.code), code.meaning, 8);
  }
  if (is_long) {
    text += heading("Topics (kinemend help NAME)");
    for (const Topic& topic : topics()) text += entry(topic.name, topic.summary, 17);
  }
  return text +
         "\nkinemend COMMAND -h explains a command, kinemend COMMAND --help in full; kinemend help "
         "NAME\nexplains a command, method or topic.\n";
}

std::string group_help(std::string_view name) {
  std::string text;
  std::vector<std::string> told;
  for (const Command& command : commands()) {
    for (const OptionGroup& group : command.groups) {
      if (group.name != name) continue;
      const std::string owners = commands_of_group(command, group);
      if (std::find(told.begin(), told.end(), owners) != told.end()) continue;
      told.push_back(owners);
      const std::string title = group_title(command, name);
      const std::size_t option = title.find("--");
      text += fmt::format(
          "{}{}\n{}", text.empty() ? "" : "\n",
          Colours::of_out().paint(
              Paint::bold,
              fmt::format("kinemend {} {}", owners,
                          option == title.npos ? std::string(name) : title.substr(option))),
          group_text(command, group));
      if (group.options.empty()) text += "  It has no options.\n";
      text += fmt::format("  Page: {}\n", page_of_group(command, name));
    }
  }
  return text;
}

std::string command_help(const Command& command, bool is_long) {
  std::string text = fmt::format("kinemend {}: {}\n\nUsage: kinemend {}\n", command.name,
                                 command.summary, usage_line(command));
  if (is_long) text += description_text(command.description);
  text += "\n";
  for (const Positional& positional : command.positionals)
    text += entry(positional.name, positional.help);
  text += flags_text(command, is_long);
  text += group_names_text(command, is_long);
  if (is_long && !command.examples.empty()) {
    text += heading("Examples");
    for (const Example& example : command.examples) text += example_text(example);
  }
  return text;
}

}  // namespace kinemend::cli
