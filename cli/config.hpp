// Settings of `clean` from presets, configuration files and the command line. Later ones override.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"

namespace kinemend::cli {

/// The settings of one source; those that it does not set are absent.
struct Settings {
  OptionValues values;                                                 ///< by flag
  std::map<std::string, std::vector<std::string>, std::less<>> lists;  ///< by flag
  std::map<std::string, OptionValues, std::less<>> methods;            ///< options by method
};

/// An embedded preset: its TOML text.
struct Preset {
  std::string_view name;
  std::string_view text;
};
std::span<const Preset> presets();
/// The first line of a preset's leading comment.
std::string preset_summary(const Preset& preset);
/// Errors: `ErrorKind::usage` with the known names.
const Preset& find_preset(std::string_view name);

/// The settings in a TOML text; `name` is for messages. Errors, with the line:
/// `ErrorKind::unreadable_input` for text that is not TOML, `ErrorKind::usage` for an unknown key
/// or a value out of range.
Settings parse_settings(const Command& clean, std::string_view text, std::string_view name);

/// Overrides settings of `base` with those of `over`.
void put_over(Settings& base, const Settings& over);

/// A TOML text with every setting of `clean`, its unit and its range, and the options of the method
/// chosen (and of those set); `parse_settings` reads it back.
std::string settings_text(const Command& clean, const Settings& settings, std::string_view heading);

}  // namespace kinemend::cli
