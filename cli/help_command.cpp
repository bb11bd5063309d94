// kinemend help: explains a command, a method, a damage or a topic.

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "help.hpp"
#include "kinemend/extend/options.hpp"
#include "terminal.hpp"
#include "topics.hpp"

namespace kinemend::cli {

namespace {

std::string topic_help(const std::string& name) {
  const auto found = std::find_if(topics().begin(), topics().end(),
                                  [&](const Topic& topic) { return topic.name == name; });
  if (found == topics().end()) return "";
  return fmt::format("kinemend, {}: {}\n{}", found->name, found->summary,
                     description_text(found->text));
}

int run_help(const Arguments& arguments) {
  if (arguments.positionals.empty()) {
    write_out(program_help(true));
    return 0;
  }
  const std::string& name = arguments.positionals.front();
  std::string text;
  for (const std::string& part :
       {find_command(name) ? command_help(*find_command(name), true) : std::string(),
        group_help(name), topic_help(name)}) {
    if (!text.empty() && !part.empty()) text += '\n';
    text += part;
  }
  if (text.empty()) {
    const std::string guess = nearest_name(name, arguments.command->positionals.front().choices);
    throw Error(
        ErrorKind::usage,
        guess.empty()
            ? fmt::format("help: unknown command, method or topic {} (see kinemend help)", name)
            : fmt::format("help: unknown command, method or topic {} (did you mean {}?)", name,
                          guess));
  }
  write_out(text);
  return 0;
}

}  // namespace

Command help_command(const std::vector<Command>& others) {
  Command command;
  command.name = "help";
  command.summary = "explain a command, a method or a topic";
  command.description =
      "NAME is a command, a method of cleaning, filling or training, a damage, or one of the "
      "topics "
      "that kinemend help lists. If a name has several meanings, all of them are explained.";
  Positional positional{"NAME", "what to explain; without it, the whole program", 0, 1, {}};
  std::vector<std::string>& names = positional.choices;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const Command& other : others) add(other.name);
  add(command.name);
  for (const Topic& topic : topics()) add(topic.name);
  for (const Command& other : others) {
    for (const OptionGroup& group : other.groups) add(group.name);
  }
  command.positionals = {std::move(positional)};
  command.examples = {{"kinemend help butterworth", "a method, with its options"},
                      {"kinemend help frames", "how frames are counted"}};
  command.run = run_help;
  return command;
}

}  // namespace kinemend::cli
