// kinemend completion: prints scripts for shells, from the tables of parser and help.

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

/// A flag in the form that shells need.
struct ShellFlag {
  std::string name;  ///< "--output"
  char letter = 0;
  std::string help;
  bool takes_value = false;
  std::vector<std::string> choices;
  Completion completion = Completion::none;
};

void add_flag(std::vector<ShellFlag>& flags, ShellFlag flag) {
  const auto known = std::find_if(flags.begin(), flags.end(),
                                  [&](const ShellFlag& f) { return f.name == flag.name; });
  if (known == flags.end()) {
    flags.push_back(std::move(flag));
    return;
  }
  // Several methods have the option: offer the values of all of them.
  known->completion = std::max(known->completion, flag.completion);
  for (std::string& choice : flag.choices) {
    if (std::find(known->choices.begin(), known->choices.end(), choice) == known->choices.end())
      known->choices.push_back(std::move(choice));
  }
}

void add_option(std::vector<ShellFlag>& flags, const OptionSpec& spec, char letter,
                bool takes_value, Completion completion) {
  const std::string name = dashed(spec.name);
  add_flag(flags, {"--" + name, letter, spec.help, takes_value, spec.choices, completion});
  const bool* is_on = std::get_if<bool>(&spec.default_value);
  if (is_on && *is_on) add_flag(flags, {"--no-" + name, 0, "not: " + spec.help, false, {}, {}});
}

std::vector<ShellFlag> flags_of(const Command& command) {
  std::vector<ShellFlag> flags;
  for (const Flag& flag : command.flags) {
    OptionSpec spec = flag.spec;
    if (!flag.offered.empty()) spec.choices = flag.offered;
    add_option(flags, spec, flag.letter, flag.takes != Takes::nothing, flag.completion);
  }
  if (command.groups_are_flags) {
    for (const OptionGroup& group : command.groups) {
      for (const OptionSpec& spec : group.options) {
        const bool is_switch = std::holds_alternative<bool>(spec.default_value);
        add_option(flags, spec, 0, !is_switch,
                   names_file(spec) ? Completion::file : Completion::none);
        if (is_switch)
          add_flag(flags, {"--no-" + dashed(spec.name), 0, "not: " + spec.help, false, {}, {}});
      }
    }
  }
  add_flag(flags, {"--help", 'h', "help", false, {}, {}});
  return flags;
}

std::vector<std::string> words_of(const Command& command) {
  for (const Positional& positional : command.positionals) {
    if (!positional.choices.empty()) return positional.choices;
  }
  return {};
}

bool takes_files(const Command& command) {
  return std::any_of(command.positionals.begin(), command.positionals.end(),
                     [](const Positional& positional) { return positional.choices.empty(); });
}

std::string all_command_names(std::string_view separator) {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.push_back(command.name);
  return fmt::format("{}", fmt::join(names, separator));
}

std::string joined(const std::vector<std::string>& parts, std::string_view separator = " ") {
  return fmt::format("{}", fmt::join(parts, separator));
}

std::string bash_reply(const std::vector<std::string>& words, Completion completion) {
  std::string text;
  if (!words.empty())
    text = fmt::format("compgen -W {} -- \"$word\"", single_quoted(joined(words)));
  if (completion != Completion::none) {
    text += fmt::format("{}compgen -{} -- \"$word\"", text.empty() ? "" : "; ",
                        completion == Completion::folder ? 'd' : 'f');
  }
  return text.empty() ? "COMPREPLY=()" : fmt::format("COMPREPLY=($({}))", text);
}

std::string bash_command(const Command& command) {
  std::string values;
  std::vector<std::string> names;
  for (const ShellFlag& flag : flags_of(command)) {
    names.push_back(flag.name);
    if (flag.letter) names.push_back(fmt::format("-{}", flag.letter));
    if (!flag.takes_value) continue;
    const std::string letter = flag.letter ? fmt::format("|-{}", flag.letter) : "";
    values += fmt::format("        {}{}) {}; return ;;\n", flag.name, letter,
                          bash_reply(flag.choices, flag.completion));
  }
  const std::string positionals =
      bash_reply(words_of(command), takes_files(command) ? Completion::file : Completion::none);
  return fmt::format(
      "    {})\n{}      if [[ $word == -* ]]; then\n"
      "        COMPREPLY=($(compgen -W {} -- \"$word\"))\n      else\n        {}\n      fi ;;\n",
      command.name,
      values.empty() ? "" : fmt::format("      case $before in\n{}      esac\n", values),
      single_quoted(joined(names)), positionals);
}

std::string bash_script() {
  std::string text = fmt::format(
      "# bash completion of kinemend\n_kinemend_words() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      // bash splits --name=value at the = if that is in COMP_WORDBREAKS.
      "  if [[ $word == '=' ]]; then\n    word=\n"
      "  elif [[ $before == '=' && $COMP_CWORD -gt 2 ]]; then\n"
      "    before=${{COMP_WORDS[COMP_CWORD-2]}}\n"
      "  elif [[ $word == --*=* ]]; then\n"
      "    before=${{word%%=*}} word=${{word#*=}}\n    joined=$before=\n  fi\n"
      "  if [[ $COMP_CWORD == 1 ]]; then\n"
      "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$word\"))\n    return\n  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n",
      all_command_names(" "));
  for (const Command& command : commands()) text += bash_command(command);
  return text +
         "  esac\n}\n_kinemend() {\n  local joined=\n  _kinemend_words\n"
         "  [[ $joined ]] && COMPREPLY=(\"${COMPREPLY[@]/#/$joined}\")\n  return 0\n}\n"
         "complete -o filenames -F _kinemend kinemend\n";
}

/// Escapes help for the brackets of zsh's _arguments.
std::string zsh_help(std::string_view help) {
  std::string result;
  for (const char c : help) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_words_and_files(const std::vector<std::string>& words) {
  return fmt::format("{{_alternative \"names:name:({})\" \"files:file:_files\"}}", joined(words));
}

std::string zsh_action(const ShellFlag& flag) {
  if (!flag.choices.empty() && flag.completion == Completion::file)
    return zsh_words_and_files(flag.choices);
  if (!flag.choices.empty()) return fmt::format("({})", joined(flag.choices));
  if (flag.completion == Completion::folder) return "_files -/";
  return flag.completion == Completion::file ? "_files" : " ";
}

std::string zsh_command(const Command& command) {
  std::string text = fmt::format("    {})\n      _arguments \\\n", command.name);
  for (const ShellFlag& flag : flags_of(command)) {
    const std::string rest =
        fmt::format("[{}]{}", zsh_help(flag.help),
                    flag.takes_value ? fmt::format(":value:{}", zsh_action(flag)) : "");
    const std::string pattern =
        fmt::format("*{}{}{}", flag.name, flag.takes_value ? "=" : "", rest);
    text += fmt::format("        {} \\\n", single_quoted(pattern));
    if (flag.letter)
      text +=
          fmt::format("        {} \\\n", single_quoted(fmt::format("*-{}{}", flag.letter, rest)));
  }
  const std::vector<std::string> words = words_of(command);
  if (!words.empty()) {
    const std::string action =
        takes_files(command) ? zsh_words_and_files(words) : fmt::format("({})", joined(words));
    text += fmt::format("        {} ;;\n", single_quoted("*:name:" + action));
  } else if (takes_files(command)) {
    text += "        '*:file:_files' ;;\n";
  } else {
    text += "        ;;\n";
  }
  return text;
}

std::string zsh_script() {
  std::string text =
      "#compdef kinemend\n_kinemend() {\n  if (( CURRENT == 2 )); then\n    local -a names=(\n";
  for (const Command& command : commands()) {
    text += fmt::format(
        "      {}\n", single_quoted(fmt::format("{}:{}", command.name, zsh_help(command.summary))));
  }
  text +=
      "    )\n    _describe 'command' names\n    _values 'option' --help --version\n    return\n  "
      "fi\n"
      "  local name=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $name in\n";
  for (const Command& command : commands()) text += zsh_command(command);
  // As a function in $fpath, the file completes when run; when sourced, it only registers itself.
  return text +
         "  esac\n}\nif [[ $funcstack[1] == _kinemend ]]; then\n  _kinemend \"$@\"\nelse\n"
         "  compdef _kinemend kinemend\nfi\n";
}

std::string fish_script() {
  const std::string top = "'__fish_use_subcommand'";
  std::string text = "# fish completion of kinemend\ncomplete -c kinemend -f\n";
  text += fmt::format("complete -c kinemend -n {} -l help -s h -d help\n", top);
  text += fmt::format("complete -c kinemend -n {} -l version -s V -d version\n", top);
  for (const Command& command : commands()) {
    text += fmt::format("complete -c kinemend -n {} -a {} -d {}\n", top, command.name,
                        single_quoted(command.summary));
  }
  for (const Command& command : commands()) {
    const std::string inside =
        fmt::format("complete -c kinemend -n '__fish_seen_subcommand_from {}'", command.name);
    for (const ShellFlag& flag : flags_of(command)) {
      text += fmt::format("{} -l {}", inside, flag.name.substr(2));
      if (flag.letter) text += fmt::format(" -s {}", flag.letter);
      text += fmt::format(" -d {}", single_quoted(flag.help));
      if (flag.takes_value) text += flag.completion == Completion::none ? " -x" : " -r -F";
      if (!flag.choices.empty()) text += fmt::format(" -a {}", single_quoted(joined(flag.choices)));
      text += "\n";
    }
    const std::vector<std::string> words = words_of(command);
    if (!words.empty()) text += fmt::format("{} -a {}\n", inside, single_quoted(joined(words)));
    if (takes_files(command)) text += fmt::format("{} -F\n", inside);
  }
  return text;
}

int run_completion(const Arguments& arguments) {
  const std::string& shell = arguments.positionals[0];
  if (shell == "bash") {
    write_out(bash_script());
  } else if (shell == "zsh") {
    write_out(zsh_script());
  } else if (shell == "fish") {
    write_out(fish_script());
  } else {
    throw Error(ErrorKind::usage,
                fmt::format("completion: unknown shell {}; known are bash, zsh and fish", shell));
  }
  return 0;
}

}  // namespace

Command completion_command() {
  Command command;
  command.name = "completion";
  command.summary = "print a completion script for a shell";
  command.description =
      "bash: load the script with eval \"$(kinemend completion bash)\". zsh: save it as _kinemend "
      "in a "
      "folder of $fpath. fish: save it as ~/.config/fish/completions/kinemend.fish.";
  command.positionals = {{"SHELL", "bash, zsh or fish", 1, 1, {"bash", "zsh", "fish"}}};
  command.run = run_completion;
  return command;
}

}  // namespace kinemend::cli
