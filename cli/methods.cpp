// kinemend methods: lists the cleaning methods.

#include <fmt/format.h>

#include "commands.hpp"
#include "help.hpp"
#include "json.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/methods.hpp"
#include "method_options.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

Json json_of_method(const Method& method) {
  Json json = {{"name", method.name}, {"summary", method.summary}, {"paper", method.paper}};
  json["options"] = Json::array();
  for (const OptionSpec& spec : method.options) json["options"].push_back(json_of(spec));
  return json;
}

std::string text_of_method(const Method& method) {
  std::string text = Colours::of_out().paint(Paint::bold, method.name) + "\n";
  text += wrap(method.summary, 2);
  if (!method.paper.empty()) text += wrap("From: " + method.paper, 2);
  Table table({Align::left, Align::left, Align::left, Align::left, Align::left}, 4);
  for (const OptionSpec& spec : method.options) {
    OptionSpec range = spec;
    range.unit.clear();
    const bool is_switch = std::holds_alternative<bool>(spec.default_value);
    table.add({(is_switch ? "--[no-]" : "--") + dashed(spec.name),
               is_switch ? (std::get<bool>(spec.default_value) ? "on" : "off")
                         : kinemend::to_string(spec.default_value),
               spec.unit, is_switch || !spec.choices.empty() ? "" : range_text(range, false),
               spec.help});
    if (!spec.choices.empty())
      table.add({"", "", "", "", fmt::format("one of {}", fmt::join(spec.choices, ", "))});
  }
  return text + table.text();
}

int run_methods(const Arguments& arguments) {
  std::vector<const Method*> chosen;
  for (const std::string& name : arguments.positionals) chosen.push_back(&find_method(name));
  if (chosen.empty()) {
    for (const Method& method : methods()) chosen.push_back(&method);
  }
  if (arguments.flag("json")) {
    Json list = Json::array();
    for (const Method* method : chosen) list.push_back(json_of_method(*method));
    write_out(json_text({{"methods", std::move(list)}}));
    return 0;
  }
  std::string text;
  for (const Method* method : chosen) {
    if (!text.empty()) text += '\n';
    text += text_of_method(*method);
  }
  write_out(text);
  return 0;
}

}  // namespace

Command methods_command() {
  Command command;
  command.name = "methods";
  command.summary = "list the cleaning methods with their options";
  command.description =
      "Prints for each method what it does, the paper it comes from, and its options with default, "
      "unit and range. They are options of kinemend clean, batch and stream.";
  command.positionals = {{"NAME", "method to describe (default all)", 0, 100, method_names()}};
  command.flags = {json_flag("print JSON instead of text")};
  command.run = run_methods;
  return command;
}

}  // namespace kinemend::cli
