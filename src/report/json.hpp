// JSON of reports, for the files of this room only.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "kinemend/report.hpp"

namespace kinemend {

using Json = nlohmann::ordered_json;

/// On one line for an `indent` of -1; bytes that are no UTF-8 are replaced.
std::string text_of(const Json& json, int indent = 2);

/// How much of a report is told: without lists, without what `clean` did to every span, all.
enum class Depth { row, summary, all };
Json take_json(const Report& report, Depth depth);
Json failure_entry(std::string_view input, std::string_view error, int exit_code);

}  // namespace kinemend
