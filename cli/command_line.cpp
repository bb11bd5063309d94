// Splits the words with CLI11 and converts them to values by the tables of flags.
#include "command_line.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"

namespace kinemend::cli {

namespace {

/// Returns the choice with exactly this name, or the only one that matches it ignoring case, or the
/// name unchanged.
std::string matching_choice(std::string_view name, const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), name) != choices.end()) return std::string(name);
  const auto is_meant = [&](const std::string& choice) { return same_but_for_case(choice, name); };
  const auto found = std::find_if(choices.begin(), choices.end(), is_meant);
  const bool is_only =
      found != choices.end() && std::find_if(found + 1, choices.end(), is_meant) == choices.end();
  return is_only ? *found : std::string(name);
}

[[noreturn]] void refuse(const Command& command, const std::string& message) {
  throw Error(ErrorKind::usage,
              fmt::format("{}: {} (see kinemend {} -h)", command.name, message, command.name));
}

std::string parser_names(const Flag& flag) {
  const std::string name = dashed(flag.spec.name);
  if (is_on_by_default(flag)) return fmt::format("--{0},!--no-{0}", name);
  std::string names = flag.letter ? fmt::format("-{},--{}", flag.letter, name) : "--" + name;
  for (const std::string& older : flag.older_names) names += ",--" + dashed(older);
  return names;
}

bool is_switch(const OptionSpec& spec) { return std::holds_alternative<bool>(spec.default_value); }

/// A name may be an option of several groups. The parser gets it once, as text.
std::vector<std::pair<std::string, bool>> distinct_group_options(const Command& command) {
  std::vector<std::pair<std::string, bool>> names;
  if (!command.groups_are_flags) return names;
  for (const OptionGroup& group : command.groups) {
    for (const OptionSpec& spec : group.options) {
      const auto known = std::find_if(names.begin(), names.end(),
                                      [&](const auto& n) { return n.first == spec.name; });
      if (known == names.end()) {
        names.emplace_back(spec.name, is_switch(spec));
      } else {
        known->second = known->second && is_switch(spec);
      }
    }
  }
  return names;
}

/// `--` ends the options: removes it and the words after it, which are inputs even if they begin
/// with a dash.
std::vector<std::string> take_behind_dashes(std::vector<std::string>& words) {
  const auto dashes = std::find(words.begin(), words.end(), "--");
  if (dashes == words.end()) return {};
  std::vector<std::string> behind(dashes + 1, words.end());
  words.erase(dashes, words.end());
  return behind;
}

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

/// Returns whether a word can only be a name that belongs to the list before it.
bool is_stray_name(const Command& command, const std::string& word) {
  std::error_code ignored;
  if (word.empty() || word == "-" || std::filesystem::exists(word, ignored)) return false;
  if (word.find('/') != std::string::npos || format_of_path(word) != nullptr) return false;
  return std::none_of(command.positionals.begin(), command.positionals.end(),
                      [&](const Positional& positional) {
                        const std::vector<std::string>& choices = positional.choices;
                        return std::find(choices.begin(), choices.end(), word) != choices.end();
                      });
}

/// Refuses `--joints A B`, where B would otherwise be reported as a missing input.
void refuse_names_beside(const Command& command, const std::vector<std::string>& words,
                         const std::string& name) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_joined = words[i].starts_with(name + "=");
    const std::size_t value = is_joined ? i : i + 1;
    const std::size_t next = value + 1;
    if ((words[i] != name && !is_joined) || next >= words.size() || is_option(words[next]))
      continue;
    if (!is_stray_name(command, words[next])) continue;
    const std::string first = is_joined ? words[i].substr(name.size() + 1) : words[value];
    refuse(command, fmt::format("{1} after {0} is neither a file nor part of the list; separate "
                                "names by commas, as in {0} {2},{1}",
                                name, words[next], first));
  }
}

void refuse_names_beside_lists(const Command& command, const std::vector<std::string>& words) {
  for (const Flag& flag : command.flags) {
    if (flag.takes != Takes::list) continue;
    refuse_names_beside(command, words, "--" + dashed(flag.spec.name));
    for (const std::string& older : flag.older_names)
      refuse_names_beside(command, words, "--" + dashed(older));
  }
}

/// Parses with CLI11, which splits the words; the tables decide what they mean.
class Parser {
 public:
  explicit Parser(const Command& command) : command_(command) {
    app_.set_help_flag();
    app_.allow_extras();
    // A path may begin with a slash on every system.
    app_.allow_windows_style_options(false);
    app_.add_flag("-h")->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app_.add_flag("--help")->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app_.add_option("words", words_)->expected(-1);
    for (const Flag& flag : command.flags) {
      options_.push_back(flag.takes == Takes::nothing ? add_switch(parser_names(flag))
                                                      : add_value(parser_names(flag)));
    }
    for (const auto& [name, is_flag] : distinct_group_options(command)) {
      const std::string typed = dashed(name);
      group_options_.emplace_back(name, is_flag ? add_switch(fmt::format("--{0},!--no-{0}", typed))
                                                : add_value("--" + typed));
    }
  }

  Request parse(std::vector<std::string> words) {
    const std::vector<std::string> behind = take_behind_dashes(words);
    refuse_names_beside_lists(command_, words);
    // CLI11 takes the words from the back.
    std::reverse(words.begin(), words.end());
    try {
      app_.parse(std::move(words));
    } catch (const CLI::ArgumentMismatch& error) {
      const std::string text = error.what();
      refuse(command_, text.substr(0, text.find(':')) + " needs a value");
    } catch (const CLI::ParseError& error) {
      refuse(command_, error.what());
    }
    Request request;
    request.arguments.command = &command_;
    if (app_.count("--help") > 0) request.kind = Request::Kind::long_help;
    if (app_.count("-h") > 0) request.kind = Request::Kind::short_help;
    if (request.kind != Request::Kind::run) return request;
    refuse_unknown();
    words_.insert(words_.end(), behind.begin(), behind.end());
    collect(request.arguments);
    return request;
  }

 private:
  CLI::Option* add_switch(const std::string& names) {
    return app_.add_flag(names)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  }
  CLI::Option* add_value(const std::string& names) {
    storage_.push_back(std::make_unique<std::vector<std::string>>());
    return app_.add_option(names, *storage_.back())
        ->type_size(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }

  void refuse_unknown() const {
    const std::vector<std::string> unknown = app_.remaining();
    if (unknown.empty()) return;
    const std::string name = unknown.front().substr(0, unknown.front().find('='));
    std::vector<std::string> known = {"--help"};
    for (const Flag& flag : command_.flags) known.push_back("--" + dashed(flag.spec.name));
    for (const auto& [option, parser_option] : group_options_)
      known.push_back("--" + dashed(option));
    const std::string guess = nearest_name(name, known);
    if (guess.empty()) refuse(command_, "unknown option " + name);
    throw Error(ErrorKind::usage, fmt::format("{}: unknown option {} (did you mean {}?)",
                                              command_.name, name, guess));
  }

  void collect(Arguments& arguments) const {
    for (std::size_t i = 0; i < options_.size(); ++i) {
      if (options_[i]->count() == 0) continue;
      const Flag& flag = command_.flags[i];
      const std::vector<std::string>& texts = options_[i]->results();
      if (flag.takes == Takes::list) {
        arguments.lists[flag.spec.name] = split_list(texts);
      } else if (flag.takes == Takes::repeated) {
        arguments.lists[flag.spec.name] = texts;
      } else {
        arguments.values[flag.spec.name] = parse_flag_value(flag.spec, texts.back());
      }
    }
    for (const auto& [name, option] : group_options_) {
      if (option->count() > 0) arguments.group_texts[name] = option->results().back();
    }
    arguments.positionals = words_;
    check_positionals(arguments);
    match_choices(arguments.positionals);
  }

  void check_positionals(const Arguments& arguments) const {
    std::size_t minimum = 0;
    std::size_t maximum = 0;
    for (const Positional& positional : command_.positionals) {
      minimum += positional.minimum;
      maximum = positional.maximum > 1000 ? positional.maximum : maximum + positional.maximum;
    }
    const std::size_t count = arguments.positionals.size();
    if (count < minimum) refuse(command_, command_.positionals[count].name + " is missing");
    if (count > maximum) refuse(command_, "unexpected argument " + arguments.positionals[maximum]);
  }

  /// Choices match in any case.
  void match_choices(std::vector<std::string>& words) const {
    std::size_t next = 0;
    for (const Positional& positional : command_.positionals) {
      for (std::size_t i = 0; i < positional.maximum && next < words.size(); ++i, ++next)
        words[next] = matching_choice(words[next], positional.choices);
    }
  }

  const Command& command_;
  CLI::App app_;
  std::vector<std::string> words_;
  std::vector<std::unique_ptr<std::vector<std::string>>> storage_;
  std::vector<CLI::Option*> options_;  ///< one per flag
  std::vector<std::pair<std::string, CLI::Option*>> group_options_;
};

Request parse_program_flag(const std::string& word) {
  Request request;
  if (word == "--version" || word == "-V") {
    request.kind = Request::Kind::version;
  } else if (word == "--help") {
    request.kind = Request::Kind::long_help;
  } else if (word == "-h") {
    request.kind = Request::Kind::short_help;
  } else {
    throw Error(ErrorKind::usage, fmt::format("unknown option {} (see kinemend -h)", word));
  }
  return request;
}

}  // namespace

OptionValue parse_flag_value(const OptionSpec& spec, const std::string& given) {
  OptionSpec typed = spec;
  typed.name = "--" + dashed(spec.name);
  const std::string text = matching_choice(given, spec.choices);
  const auto& choices = spec.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end()) {
    const std::string guess = nearest_name(text, choices);
    if (!guess.empty()) {
      throw Error(ErrorKind::usage,
                  fmt::format("{}: unknown name {} (did you mean {}?)", typed.name, text, guess));
    }
  }
  return parse_option(typed, text);
}

std::vector<std::string> split_list(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      if (end > begin) parts.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  return parts;
}

Request parse_command_line(const std::vector<std::string>& words) {
  if (words.empty()) throw Error(ErrorKind::usage, "a command is missing (see kinemend -h)");
  const std::string& first = words.front();
  if (first.empty() || first[0] == '-') return parse_program_flag(first);
  const Command* command = find_command(first);
  if (!command) {
    std::vector<std::string> names;
    for (const Command& known : commands()) names.push_back(known.name);
    const std::string guess = nearest_name(first, names);
    throw Error(ErrorKind::usage,
                guess.empty() ? fmt::format("unknown command {} (see kinemend -h)", first)
                              : fmt::format("unknown command {} (did you mean {}?)", first, guess));
  }
  Parser parser(*command);
  return parser.parse({words.begin() + 1, words.end()});
}

}  // namespace kinemend::cli
