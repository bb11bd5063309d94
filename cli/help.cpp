// Lays out the flags, groups of options, exit codes and examples of each command as text.
#include "help.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/experimental/version.hpp"
#include "platform/console.hpp"
#include "terminal.hpp"
#include "topics.hpp"

namespace kinemend::cli {

namespace {

constexpr std::size_t help_column = 30;

/// A name and its text beside it, or below it if the name is long.
std::string entry(std::string_view name, std::string_view text, std::size_t column = help_column) {
  std::string line = fmt::format("  {}", name);
  const std::size_t width = display_width(line);
  if (width + 2 > column) return line + "\n" + wrap(text, column);
  return line + std::string(column - width, ' ') + wrap(text, column, 96, true);
}

std::string heading(std::string_view text) {
  return fmt::format("\n{}\n", Colours::of_out().paint(Paint::bold, fmt::format("{}:", text)));
}

std::string flags_text(const Command& command, bool is_long) {
  std::string text;
  std::string group;
  for (const Flag& flag : command.flags) {
    if (flag.group != group) text += heading(flag.group);
    group = flag.group;
    text += entry(flag_names(flag), flag_line(flag));
    if (is_long && !flag.details.empty()) text += wrap(flag.details, help_column);
  }
  text += heading("Help");
  text += entry("-h, --help", "-h prints this list, --help adds details and examples");
  return text;
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

std::string groups_text(const Command& command) {
  std::string text;
  for (const OptionGroup& group : command.groups)
    text += heading(group_title(command, group.name)) + group_text(command, group);
  return text;
}

std::string group_names_text(const Command& command) {
  if (command.groups.empty()) return "";
  std::string text = heading(group_title(command, "NAME") + " (NAME is one of these)");
  for (const OptionGroup& group : command.groups) text += entry(group.name, group.summary, 18);
  return text;
}

}  // namespace

std::string description_text(const std::string& description) {
  std::string text;
  std::size_t begin = 0;
  while (begin < description.size()) {
    const std::size_t end = std::min(description.find("\n\n", begin), description.size());
    text += '\n';
    text += wrap(description.substr(begin, end - begin), 0);
    begin = end + 2;
  }
  return text;
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
  // Without a name of its own, the value is shown as its choices: they are not repeated.
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
  for (const Command& command : commands()) {
    // It has the same methods as clean.
    if (command.name == "batch") continue;
    for (const OptionGroup& group : command.groups) {
      if (group.name != name) continue;
      const std::string title = group_title(command, name);
      const std::size_t option = title.find("--");
      text += fmt::format(
          "{}{}\n", text.empty() ? "" : "\n",
          Colours::of_out().paint(
              Paint::bold,
              fmt::format("kinemend {} {}", command.name,
                          option == title.npos ? std::string(name) : title.substr(option))));
      text += group_text(command, group);
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
  text += is_long ? groups_text(command) : group_names_text(command);
  if (is_long && !command.examples.empty()) {
    text += heading("Examples");
    for (const Example& example : command.examples)
      text += fmt::format("  {}\n{}", example.command, wrap(example.explanation, 6));
  }
  return text;
}

}  // namespace kinemend::cli
