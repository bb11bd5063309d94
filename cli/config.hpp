#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"

// Settings of `clean` from presets, configuration files and the command line, one over the other.
namespace kinemend::cli {

/// What one source sets; what it does not set is absent.
struct Settings {
  OptionValues values;                                                 ///< by flag
  std::map<std::string, std::vector<std::string>, std::less<>> lists;  ///< by flag
  std::map<std::string, OptionValues, std::less<>> methods;            ///< options by method
};

/// A preset as it is embedded: its TOML text.
struct Preset {
  std::string_view name;
  std::string_view text;
};
std::span<const Preset> presets();
/// The first line of a preset's leading comment.
std::string preset_summary(const Preset& preset);
/// Errors: `ErrorKind::usage` with the names there are.
const Preset& find_preset(std::string_view name);

/// The settings in a TOML text; `name` stands in messages. Errors: `ErrorKind::unreadable_input`
/// for what is no TOML, `ErrorKind::usage` for an unknown key or a value out of range, both with
/// the line.
Settings parse_settings(const Command& clean, std::string_view text, std::string_view name);

/// Puts `over` over `base`.
void put_over(Settings& base, const Settings& over);

/// A TOML text with every setting of `clean`, its unit and its range, and the options of the method
/// chosen (and of those set); `parse_settings` reads it back.
std::string settings_text(const Command& clean, const Settings& settings, std::string_view heading);

}  // namespace kinemend::cli
