// kinemend man: the manual page, from the tables of commands, methods and damages.

#include <fmt/format.h>

#include "commands.hpp"
#include "config.hpp"
#include "help.hpp"
#include "kinemend/extend/system.hpp"
#include "terminal.hpp"
#include "topics.hpp"

namespace kinemend::cli {

namespace {

/// Escapes text for troff.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '\n') {
      result += ' ';
    } else {
      result += c;
    }
  }
  // A control character at the start of a line would make it a request.
  if (!result.empty() && (result[0] == '.' || result[0] == '\'')) result.insert(0, "\\&");
  return result;
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return std::string(begin == std::string_view::npos ? "" : text.substr(begin));
}

std::string item(std::string_view name, std::string_view text) {
  return fmt::format(".TP\n.B {}\n{}\n", roff(trimmed(name)), roff(text));
}

std::string paragraphs(const std::string& text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    result += fmt::format(".PP\n{}\n", roff(text.substr(begin, end - begin)));
    begin = end + 2;
  }
  return result;
}

std::string group_section(const Command& command, const OptionGroup& group) {
  std::string title = command.group_heading;
  title.replace(title.find('%'), 1, group.name);
  std::string text = fmt::format(".PP\n.I {}\n.br\n{}", roff(title), roff(group.summary));
  text += group.paper.empty() ? "\n" : fmt::format(" ({})\n", roff(group.paper));
  for (const OptionSpec& spec : group.options)
    text += item(group_option_name(command, spec), group_option_line(spec));
  return text;
}

std::string command_section(const Command& command) {
  std::string text = fmt::format(".SH \"KINEMEND {}\"\n.B kinemend\n{}\n", roff(command.name),
                                 roff(usage_line(command)));
  text += paragraphs(command.description);
  for (const Positional& positional : command.positionals)
    text += item(positional.name, positional.help);
  for (const auto& [heading, flags] : flags_by_group(command)) {
    text += fmt::format(".SS {}\n", roff(heading));
    for (const Flag* flag : flags) {
      text += item(flag_names(*flag),
                   flag_line(*flag) + (flag->details.empty() ? "." : ". " + flag->details));
    }
  }
  if (!command.groups.empty()) text += ".SS Options by name\n";
  for (const OptionGroup& group : command.groups) text += group_section(command, group);
  if (!command.examples.empty()) text += ".SS Examples\n";
  for (const Example& example : command.examples)
    text += item(example.command, example.explanation);
  return text;
}

std::string page() {
  std::string text = fmt::format(
      ".TH KINEMEND 1 \"\" \"kinemend {}\" \"User Commands\"\n.SH NAME\n"
      "kinemend \\- cleans human motion capture\n.SH SYNOPSIS\n",
      version());
  for (const Command& command : commands())
    text += fmt::format(".B kinemend\n{}\n.br\n", roff(usage_line(command)));
  text += ".SH COMMANDS\n";
  for (const Command& command : commands()) text += item(command.name, command.summary);
  for (const Command& command : commands()) text += command_section(command);
  text += ".SH TOPICS\n";
  for (const Topic& topic : topics()) {
    if (topic.name == "exit-codes") continue;
    text += fmt::format(".SS {}\n", roff(topic.name)) + paragraphs(topic.text);
  }
  text += ".SH EXIT STATUS\n";
  for (const ExitCode& code : exit_codes())
    text += item(fmt::format("{}", code.code), code.meaning + ".");
  text += ".SH ENVIRONMENT\n";
  text += item("NO_COLOR", "If set, output has no colours.");
  return text;
}

int run(const Arguments&) {
  write_out(page());
  return 0;
}

}  // namespace

Command man_command() {
  Command command;
  command.name = "man";
  command.summary = "print the manual page";
  command.description = "The page is in troff format, for man.";
  command.examples = {{"kinemend man | man -l -", "read the manual page"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
