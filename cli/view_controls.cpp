// Builds the controls of the page from the tables of flags, methods and presets.
#include "view_controls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <variant>

#include "command.hpp"
#include "config.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/fill.hpp"
#include "method_options.hpp"

namespace kinemend::cli {

namespace {

Settings preset_settings(const Preset& preset) {
  return parse_settings(*find_command("clean"), preset.text, fmt::format("preset {}", preset.name));
}

/// Flags that the page may set; none of them reads or writes a file.
constexpr std::array page_cleaning_flags = {
    "method", "source",   "strength", "max_change_deg", "max_change",
    "fill",   "fill_all", "feet",     "fix_swaps",      "peak_loss_limit",
    "joints", "exclude",  "range",    "root_position",  "preset"};
constexpr std::array page_filling_flags = {"method", "joints",      "range",
                                           "donor",  "longest_gap", "fill_all"};

/// The method that these flags select: the named one, that of the preset, or the default.
const Method* method_of(const std::vector<AskedFlag>& flags) {
  const auto text = [&](std::string_view name) {
    const auto found = std::find_if(flags.begin(), flags.end(),
                                    [&](const AskedFlag& flag) { return flag.name == name; });
    const auto* value = found == flags.end() ? nullptr : std::get_if<std::string>(&found->value);
    return value == nullptr ? std::string() : *value;
  };
  std::string method = text("method");
  if (const std::string preset = text("preset"); method.empty() && !preset.empty()) {
    const Settings settings = preset_settings(find_preset(preset));
    if (const auto set = settings.values.find("method"); set != settings.values.end())
      method = std::get<std::string>(set->second);
  }
  return method_called(method.empty() ? std::string(default_method) : method);
}

bool is_option(const Method* method, std::string_view name) {
  return method != nullptr &&
         std::any_of(method->options.begin(), method->options.end(), [&](const OptionSpec& spec) {
           return spec.name == name && !names_file(spec);
         });
}

// Adds the kind of control: "switch", "choice" (of names, or any text), "whole" or "number".
Json control_json(const OptionSpec& spec) {
  Json control = json_of(spec);
  control["kind"] = std::holds_alternative<bool>(spec.default_value)           ? "switch"
                    : std::holds_alternative<std::string>(spec.default_value)  ? "choice"
                    : std::holds_alternative<std::int64_t>(spec.default_value) ? "whole"
                                                                               : "number";
  return control;
}

// The flags of a command that the page may set.
Json flags_json(std::string_view command, std::span<const char* const> names) {
  Json list = Json::array();
  for (const Flag& flag : find_command(command)->flags) {
    if (std::find(names.begin(), names.end(), flag.spec.name) == names.end()) continue;
    Json control = control_json(flag.spec);
    if (!flag.details.empty()) control["help"] = flag.spec.help + ". " + flag.details;
    list.push_back(std::move(control));
  }
  return list;
}

Json methods_json() {
  Json list = Json::array();
  for (const Method& method : methods()) {
    Json entry = {{"name", method.name}, {"summary", method.summary}, {"options", Json::array()}};
    for (const OptionSpec& spec : method.options) {
      if (names_file(spec)) continue;
      entry["options"].push_back(control_json(spec));
    }
    list.push_back(std::move(entry));
  }
  return list;
}

// The values that each preset sets, for the controls of the page.
Json presets_json() {
  Json list = Json::array();
  for (const Preset& preset : presets()) {
    const Settings settings = preset_settings(preset);
    Json options = Json::object();
    for (const auto& [method, values] : settings.methods) options[method] = json_of(values);
    list.push_back({{"name", preset.name},
                    {"summary", preset_summary(preset)},
                    {"values", json_of(settings.values)},
                    {"options", std::move(options)}});
  }
  return list;
}

Json fill_methods_json() {
  Json list = Json::array();
  for (const FillMethod& method : fill_methods()) {
    if (method.learned) continue;  // the page cannot choose a model
    list.push_back({{"name", method.name},
                    {"summary", method.summary},
                    {"joints", method.joints},
                    {"markers", method.markers}});
  }
  return list;
}

}  // namespace

Json view_controls() {
  return {{"flags",
           {{"clean", flags_json("clean", page_cleaning_flags)},
            {"fill", flags_json("fill", page_filling_flags)}}},
          {"methods", methods_json()},
          {"presets", presets_json()},
          {"fill_methods", fill_methods_json()}};
}

Json why_not_methods(const Take& take) {
  Json reasons = Json::object();
  for (const Method& method : methods()) {
    if (std::string reason = why_not(method, take); !reason.empty())
      reasons[method.name] = std::move(reason);
  }
  return reasons;
}

void check_view_flag(const ViewAsked& asked, const std::string& name) {
  const auto among = [&](const auto& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const bool known = asked.is_fill
                         ? among(page_filling_flags)
                         : among(page_cleaning_flags) || is_option(method_of(asked.flags), name);
  if (!known)
    throw Error(ErrorKind::usage, fmt::format("view: the page may not set {}", printable(name)));
}

}  // namespace kinemend::cli
