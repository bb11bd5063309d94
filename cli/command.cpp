// Lists all commands, builds flags of each type, and gives typed access to parsed arguments.
#include "command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinemend::cli {

const Command* find_command(std::string_view name) {
  for (const Command& command : commands()) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

OptionValue Arguments::value(std::string_view name) const {
  if (const auto found = values.find(name); found != values.end()) return found->second;
  for (const Flag& flag : command->flags) {
    if (flag.spec.name == name) return flag.spec.default_value;
  }
  throw std::logic_error("no flag is called " + std::string(name));
}

std::vector<std::string> Arguments::list(std::string_view name) const {
  const auto found = lists.find(name);
  return found == lists.end() ? std::vector<std::string>() : found->second;
}

Flag switch_flag(std::string name, std::string group, std::string help, std::string details) {
  Flag flag;
  flag.spec = {std::move(name), "", false, 0, 1, {}, std::move(help)};
  flag.takes = Takes::nothing;
  flag.group = std::move(group);
  flag.details = std::move(details);
  return flag;
}

Flag number_flag(std::string name, std::string unit, double default_value, double minimum,
                 double maximum, std::string group, std::string help, std::string details) {
  Flag flag;
  flag.spec = {std::move(name), std::move(unit), default_value, minimum, maximum, {},
               std::move(help)};
  flag.group = std::move(group);
  flag.details = std::move(details);
  return flag;
}

Flag whole_flag(std::string name, std::int64_t default_value, double minimum, double maximum,
                std::string group, std::string help, std::string details) {
  Flag flag;
  flag.spec = {std::move(name), "", default_value, minimum, maximum, {}, std::move(help)};
  flag.group = std::move(group);
  flag.details = std::move(details);
  return flag;
}

Flag text_flag(std::string name, std::string value_name, std::string group, std::string help,
               std::string details) {
  Flag flag;
  flag.spec = {std::move(name), "", std::string(), 0, 0, {}, std::move(help)};
  flag.value_name = std::move(value_name);
  flag.group = std::move(group);
  flag.details = std::move(details);
  flag.has_default = false;
  return flag;
}

Flag file_flag(std::string name, std::string value_name, std::string group, std::string help,
               std::string details, Completion completion) {
  Flag flag = text_flag(std::move(name), std::move(value_name), std::move(group), std::move(help),
                        std::move(details));
  flag.completion = completion;
  return flag;
}

Flag choice_flag(std::string name, std::string group, std::string help,
                 std::vector<std::string> choices, std::string default_choice,
                 std::string details) {
  Flag flag = text_flag(std::move(name), "", std::move(group), std::move(help), std::move(details));
  flag.spec.choices = std::move(choices);
  flag.has_default = !default_choice.empty();
  flag.spec.default_value = std::move(default_choice);
  return flag;
}

Flag without_default(Flag flag) {
  flag.has_default = false;
  return flag;
}

bool is_on_by_default(const Flag& flag) {
  const bool* is_on = std::get_if<bool>(&flag.spec.default_value);
  return is_on && *is_on;
}

bool names_file(const OptionSpec& spec) {
  return spec.choices.empty() && std::holds_alternative<std::string>(spec.default_value);
}

std::string single_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

std::string shell_word(std::string_view word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=+@%";
  const bool is_plain = !word.empty() && word.find_first_not_of(plain) == word.npos;
  return is_plain ? std::string(word) : single_quoted(word);
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line = "kinemend";
  for (const std::string& word : words) line += " " + shell_word(word);
  return line;
}

std::string dashed(std::string_view name) {
  std::string result(name);
  std::replace(result.begin(), result.end(), '_', '-');
  return result;
}

std::string value_name(const Flag& flag) {
  if (flag.takes == Takes::nothing) return "";
  if (!flag.value_name.empty()) return flag.value_name;
  if (!flag.spec.choices.empty()) return fmt::format("{}", fmt::join(flag.spec.choices, "|"));
  if (std::holds_alternative<std::int64_t>(flag.spec.default_value)) return "N";
  if (std::holds_alternative<double>(flag.spec.default_value)) return "X";
  return "TEXT";
}

namespace {

/// The shortest exact text of a number; three significant digits if that is too long (0.667).
std::string shown_default(const OptionValue& value) {
  constexpr std::size_t most_characters = 8;
  std::string text = kinemend::to_string(value);
  const double* number = std::get_if<double>(&value);
  return number != nullptr && text.size() > most_characters ? fmt::format("{:.3g}", *number) : text;
}

}  // namespace

std::string range_text(const OptionSpec& spec, bool has_default) {
  const bool is_number = std::holds_alternative<double>(spec.default_value) ||
                         std::holds_alternative<std::int64_t>(spec.default_value);
  std::string text;
  if (!spec.choices.empty()) text = fmt::format("{}", fmt::join(spec.choices, ", "));
  if (is_number) {
    const std::string unit = spec.unit.empty() ? "" : " " + spec.unit;
    if (std::isfinite(spec.maximum)) {
      text = fmt::format("{} to {}{}", spec.minimum, spec.maximum, unit);
    } else if (std::isfinite(spec.minimum)) {
      text = fmt::format("{}{} or more", spec.minimum, unit);
    } else if (!spec.unit.empty()) {
      text = "in " + spec.unit;
    }
  }
  const std::string value = shown_default(spec.default_value);
  if (!has_default || value.empty()) return text;
  return fmt::format("{}{}default {}", text, text.empty() ? "" : "; ", value);
}

}  // namespace kinemend::cli
