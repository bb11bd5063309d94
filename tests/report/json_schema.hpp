// Checks JSON by the part of JSON Schema that docs/report.schema.json uses.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace kinemend::test {

class JsonSchema {
 public:
  using Json = nlohmann::json;

  explicit JsonSchema(const std::filesystem::path& path) {
    std::ifstream file(path);
    root_ = Json::parse(file);
  }

  /// Returns a line for each violation of the schema.
  std::vector<std::string> problems(const Json& value) const {
    std::vector<std::string> lines;
    check(value, root_, "", lines);
    return lines;
  }
  /// Checks against one of the schema's definitions.
  std::vector<std::string> problems(const Json& value, const std::string& definition) const {
    std::vector<std::string> lines;
    check(value, root_.at("$defs").at(definition), "", lines);
    return lines;
  }

 private:
  using Lines = std::vector<std::string>;

  static bool has_type(const Json& value, const std::string& type) {
    if (type == "integer") return value.is_number_integer();
    return (type == "null" && value.is_null()) || (type == "boolean" && value.is_boolean()) ||
           (type == "number" && value.is_number()) || (type == "string" && value.is_string()) ||
           (type == "array" && value.is_array()) || (type == "object" && value.is_object());
  }

  void check(const Json& value, const Json& schema, const std::string& place, Lines& lines) const {
    static const std::vector<std::string> known = {
        "$schema",    "$id",      "$defs", "$ref",    "title", "description",          "type",
        "properties", "required", "items", "minimum", "enum",  "additionalProperties", "const",
        "oneOf"};
    for (const auto& [key, ignored] : schema.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end())
        lines.push_back("the schema says " + key + ", which the test does not know");
    }
    if (schema.contains("$ref")) {
      const std::string name = schema["$ref"];
      check(value, root_.at(Json::json_pointer(name.substr(1))), place, lines);
    }
    if (schema.contains("oneOf")) check_one_of(value, schema["oneOf"], place, lines);
    if (schema.contains("const") && value != schema["const"])
      lines.push_back(place + " is " + value.dump());
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
      lines.push_back(place + " is none of the words: " + value.dump());
    }
    if (schema.contains("type")) {
      const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
      if (std::none_of(types.begin(), types.end(),
                       [&](const Json& type) { return has_type(value, type); })) {
        lines.push_back(place + " is no " + types.dump() + ": " + value.dump().substr(0, 60));
        return;
      }
    }
    if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
      lines.push_back(place + " is too small: " + value.dump());
    if (value.is_object()) check_members(value, schema, place, lines);
    if (value.is_array() && schema.contains("items")) {
      for (std::size_t i = 0; i < value.size(); ++i)
        check(value[i], schema["items"], place + "/" + std::to_string(i), lines);
    }
  }

  void check_members(const Json& value, const Json& schema, const std::string& place,
                     Lines& lines) const {
    for (const Json& name : schema.value("required", Json::array())) {
      if (!value.contains(name.get<std::string>()))
        lines.push_back(place + " lacks " + name.get<std::string>());
    }
    const Json properties = schema.value("properties", Json::object());
    const Json others = schema.value("additionalProperties", Json(true));
    for (const auto& [key, member] : value.items()) {
      const std::string inner = place + "/" + key;
      if (properties.contains(key)) {
        check(member, properties[key], inner, lines);
      } else if (others.is_object()) {
        check(member, others, inner, lines);
      } else if (others == false) {
        lines.push_back(inner + " is not in the schema");
      }
    }
  }

  // Reports the violations of the alternative that fits best.
  void check_one_of(const Json& value, const Json& schemas, const std::string& place,
                    Lines& lines) const {
    std::size_t fitting = 0;
    Lines best;
    for (const Json& schema : schemas) {
      Lines own;
      check(value, schema, place, own);
      fitting += own.empty() ? 1 : 0;
      if (best.empty() || own.size() < best.size()) best = own;
    }
    if (fitting > 1) lines.push_back(place + " fits several");
    if (fitting == 0) lines.insert(lines.end(), best.begin(), best.end());
  }

  Json root_;
};

/// Loads docs/report.schema.json.
inline const JsonSchema& report_schema_file() {
  static const JsonSchema schema(std::filesystem::path(KINEMEND_TEST_FIXTURES) /
                                 "../../docs/report.schema.json");
  return schema;
}

}  // namespace kinemend::test
