// Reads TOML with line numbers for errors, and writes settings back as commented TOML.
#include "config.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/methods.hpp"
#include "method_options.hpp"

namespace kinemend::cli {

namespace {

[[noreturn]] void refuse(ErrorKind kind, std::string_view name, toml::source_index line,
                         std::string_view message) {
  throw Error(kind, fmt::format("{}:{}: {}", name, line, message));
}

/// Reads the nodes of one file, whose name begins every message.
class Reader {
 public:
  Reader(const Command& clean, std::string_view name) : clean_(clean), name_(name) {}

  Settings read(const toml::table& root) const {
    Settings settings;
    for (const auto& [key, node] : root) {
      if (const toml::table* options = node.as_table()) {
        settings.methods[std::string(key.str())] = read_method(key.str(), *options);
      } else {
        read_setting(settings, key.str(), node);
      }
    }
    return settings;
  }

 private:
  OptionValues read_method(std::string_view key, const toml::table& table) const {
    const Method* method = method_called(key);
    if (!method) refuse_unknown("method", key, line_of(table), method_names());
    OptionValues values;
    for (const auto& [option_key, node] : table) {
      const std::string_view name = option_key.str();
      const auto spec = std::find_if(method->options.begin(), method->options.end(),
                                     [&](const OptionSpec& s) { return s.name == name; });
      if (spec == method->options.end()) {
        std::vector<std::string> names;
        for (const OptionSpec& known : method->options) names.push_back(known.name);
        refuse_unknown("option of " + method->name, name, line_of(node), names);
      }
      values[spec->name] = checked(*spec, node);
    }
    return values;
  }

  void read_setting(Settings& settings, std::string_view key, const toml::node& node) const {
    for (const Flag& flag : clean_.flags) {
      if (!flag.configurable || flag.spec.name != key) continue;
      if (flag.takes == Takes::list) {
        settings.lists[flag.spec.name] = texts(flag.spec, node);
      } else {
        settings.values[flag.spec.name] = checked(flag.spec, node);
      }
      return;
    }
    std::vector<std::string> names;
    for (const Flag& flag : clean_.flags) {
      if (flag.configurable) names.push_back(flag.spec.name);
    }
    refuse_unknown("setting", key, line_of(node), names);
  }

  OptionValue checked(const OptionSpec& spec, const toml::node& node) const {
    try {
      if (const auto* number = node.as_floating_point()) return check_option(spec, number->get());
      if (const auto* whole = node.as_integer()) return check_option(spec, whole->get());
      if (const auto* flag = node.as_boolean()) return check_option(spec, flag->get());
      if (const auto* text = node.as_string()) return check_option(spec, text->get());
    } catch (const Error& error) {
      refuse(error.kind(), name_, line_of(node), error.what());
    }
    refuse(ErrorKind::usage, name_, line_of(node), spec.name + ": has the wrong type");
  }

  std::vector<std::string> texts(const OptionSpec& spec, const toml::node& node) const {
    std::vector<std::string> result;
    const toml::array* list = node.as_array();
    if (!list) refuse(ErrorKind::usage, name_, line_of(node), spec.name + ": is not a list");
    for (const toml::node& entry : *list) {
      const auto* text = entry.as_string();
      if (!text)
        refuse(ErrorKind::usage, name_, line_of(entry), spec.name + ": expected texts in quotes");
      result.push_back(text->get());
    }
    return result;
  }

  [[noreturn]] void refuse_unknown(std::string_view what, std::string_view key,
                                   toml::source_index line,
                                   const std::vector<std::string>& known) const {
    const std::string guess = nearest_name(key, known);
    refuse(ErrorKind::usage, name_, line,
           fmt::format("unknown {} {}{}", what, key,
                       guess.empty() ? "" : fmt::format(" (did you mean {}?)", guess)));
  }

  static toml::source_index line_of(const toml::node& node) { return node.source().begin.line; }

  const Command& clean_;
  std::string_view name_;
};

std::string toml_quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string toml_text(const OptionValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text ? toml_quoted(*text) : kinemend::to_string(value);
}

std::string comment(std::string_view text) {
  std::string result;
  const std::string lines = wrap(text, 0, 94);
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin);
    result += "# " + lines.substr(begin, end - begin + 1);
    begin = end + 1;
  }
  return result;
}

std::string setting_text(const OptionSpec& spec, const std::string& details,
                         const std::string& value) {
  std::string text = spec.help;
  if (const std::string range = range_text(spec); !range.empty()) text += " (" + range + ")";
  if (!details.empty()) text += ". " + details;
  return comment(text) + fmt::format("{} = {}\n\n", spec.name, value);
}

std::string list_text(const std::vector<std::string>& list) {
  std::vector<std::string> parts;
  parts.reserve(list.size());
  for (const std::string& part : list) parts.push_back(toml_quoted(part));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string method_text(const Method& method, const OptionValues& values) {
  std::string text = comment(method.summary) + fmt::format("[{}]\n", method.name);
  for (const OptionSpec& spec : method.options) {
    const auto set = values.find(spec.name);
    text +=
        setting_text(spec, "", toml_text(set == values.end() ? spec.default_value : set->second));
  }
  return text;
}

}  // namespace

std::string preset_summary(const Preset& preset) {
  const std::string_view line = preset.text.substr(0, preset.text.find('\n'));
  return std::string(line.substr(std::min<std::size_t>(line.find(':'), line.size() - 2) + 2));
}

const Preset& find_preset(std::string_view name) {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) {
    if (preset.name == name) return preset;
    names.emplace_back(preset.name);
  }
  throw Error(ErrorKind::usage,
              fmt::format("--preset: {} is not one of {}", name, fmt::join(names, ", ")));
}

Settings parse_settings(const Command& clean, std::string_view text, std::string_view name) {
  try {
    return Reader(clean, name).read(toml::parse(text));
  } catch (const toml::parse_error& error) {
    refuse(ErrorKind::unreadable_input, name, error.source().begin.line, error.description());
  }
}

void put_over(Settings& base, const Settings& over) {
  for (const auto& [name, value] : over.values) base.values[name] = value;
  for (const auto& [name, list] : over.lists) base.lists[name] = list;
  for (const auto& [method, values] : over.methods) {
    OptionValues& known = base.methods[method];
    for (const auto& [name, value] : values) known[name] = value;
  }
}

std::string settings_text(const Command& clean, const Settings& settings,
                          std::string_view heading) {
  std::string text = comment(heading) + "\n";
  std::string chosen;
  for (const Flag& flag : clean.flags) {
    if (!flag.configurable) continue;
    const std::string& name = flag.spec.name;
    if (flag.takes == Takes::list) {
      const auto set = settings.lists.find(name);
      text += setting_text(
          flag.spec, flag.details,
          list_text(set == settings.lists.end() ? std::vector<std::string>() : set->second));
      continue;
    }
    const auto set = settings.values.find(name);
    const OptionValue& value = set == settings.values.end() ? flag.spec.default_value : set->second;
    if (name == "method") chosen = kinemend::to_string(value);
    text += setting_text(flag.spec, flag.details, toml_text(value));
  }
  for (const Method& method : methods()) {
    const auto set = settings.methods.find(method.name);
    if (set != settings.methods.end()) {
      text += method_text(method, set->second);
    } else if (method.name == chosen && !method.options.empty()) {
      text += method_text(method, {});
    }
  }
  text.pop_back();
  return text;
}

}  // namespace kinemend::cli
