#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "kinemend/diagnostics.hpp"
#include "kinemend/options.hpp"

namespace kinemend::cli {

using Json = nlohmann::ordered_json;

/// Indented, ended by a newline; bytes that are no UTF-8 are replaced.
std::string json_text(const Json& json);
Json json_of(const OptionValue& value);
Json json_of(const OptionValues& values);
Json json_of(const OptionSpec& spec);
/// `first_line` of each, or `first_byte` of a format whose places are bytes.
Json json_of(const Diagnostics& diagnostics, std::string_view format);

}  // namespace kinemend::cli
