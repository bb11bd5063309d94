// JSON of reports, used only inside this folder.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "kinemend/report.hpp"

namespace kinemend {

using Json = nlohmann::ordered_json;

/// Returns the JSON as text, on one line for an `indent` of -1. Invalid UTF-8 is replaced.
std::string text_of(const Json& json, int indent = 2);

/// The amount of detail of a report: without lists, without the changed spans of `clean`, or all.
enum class Depth { row, summary, all };
Json take_json(const Report& report, Depth depth);
Json failure_entry(std::string_view input, std::string_view error, int exit_code);

}  // namespace kinemend
