// Converts option values, options and repairs to JSON.
#include "json.hpp"

#include <cmath>

#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"

namespace kinemend::cli {

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json json_of(const OptionValue& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

Json json_of(const OptionValues& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = json_of(value);
  return json;
}

Json json_of(const OptionSpec& spec) {
  Json json = {{"name", spec.name}, {"help", spec.help}, {"default", json_of(spec.default_value)}};
  if (!spec.unit.empty()) json["unit"] = spec.unit;
  if (!spec.choices.empty()) json["choices"] = spec.choices;
  const bool is_number = std::holds_alternative<double>(spec.default_value) ||
                         std::holds_alternative<std::int64_t>(spec.default_value);
  if (is_number && std::isfinite(spec.minimum)) json["minimum"] = spec.minimum;
  if (is_number && std::isfinite(spec.maximum)) json["maximum"] = spec.maximum;
  return json;
}

Json json_of(const Diagnostics& diagnostics, std::string_view format) {
  return parse_json<Json>(diagnostics_json(diagnostics, format));
}

}  // namespace kinemend::cli
