// The JSON that commands print: its text, and the values of options and repairs in it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/options.hpp"

namespace kinemend::cli {

using Json = nlohmann::ordered_json;

/// Indented JSON with a newline at the end; bytes that are not UTF-8 are replaced.
std::string json_text(const Json& json);
Json json_of(const OptionValue& value);
Json json_of(const OptionValues& values);
Json json_of(const OptionSpec& spec);
/// Each has `first_line`, or `first_byte` in a binary format.
Json json_of(const Diagnostics& diagnostics, std::string_view format);

}  // namespace kinemend::cli
