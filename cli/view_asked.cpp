// Parses the JSON of a request and refuses members of a wrong type.
#include "view_asked.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend::cli {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_request(std::string_view why) {
  throw Error(ErrorKind::usage, fmt::format("not a request of the page: {}", why));
}

Json request_json(std::string_view body) {
  if (json_within_depth(body).size() < body.size())
    refuse_request(fmt::format("its JSON is nested more than {} levels deep", deepest_json));
  Json json = parse_json<Json>(body, false);
  if (json.is_discarded()) refuse_request("it is not valid JSON");
  if (!json.is_object()) refuse_request("it is not a JSON object");
  return json;
}

std::optional<std::string> text_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || found->is_null()) return std::nullopt;
  if (!found->is_string()) refuse_request(fmt::format("{} is not a text", name));
  return found->get<std::string>();
}

bool switch_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || found->is_null()) return false;
  if (!found->is_boolean()) refuse_request(fmt::format("{} is neither true nor false", name));
  return found->get<bool>();
}

std::size_t count_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || found->is_null()) return 0;
  if (!found->is_number_unsigned())
    refuse_request(fmt::format("{} is not a whole number from 0", name));
  return found->get<std::size_t>();
}

std::vector<AskedFlag> flags_in(const Json& json) {
  std::vector<AskedFlag> flags;
  const auto found = json.find("flags");
  if (found == json.end() || found->is_null()) return flags;
  if (!found->is_object()) refuse_request("flags is not an object");
  for (const auto& [name, value] : found->items()) {
    AskedFlag& flag = flags.emplace_back(AskedFlag{name, false});
    if (value.is_boolean()) {
      flag.value = value.get<bool>();
    } else if (value.is_string()) {
      flag.value = value.get<std::string>();
    } else if (value.is_number()) {
      flag.value = value.dump();
    } else {
      refuse_request("a flag has neither a text, a number, true nor false");
    }
  }
  return flags;
}

}  // namespace

ViewAsked parse_view_asked(std::string_view body) {
  constexpr std::size_t longest_tab = 64;
  const Json json = request_json(body);
  ViewAsked asked;
  asked.tab = text_in(json, "tab").value_or("").substr(0, longest_tab);
  const std::string command = text_in(json, "command").value_or("clean");
  if (command != "clean" && command != "fill")
    refuse_request("its command is neither clean nor fill");
  asked.is_fill = command == "fill";
  asked.flags = flags_in(json);
  asked.contacts = text_in(json, "contacts");
  asked.plan = text_in(json, "plan");
  asked.gaps = text_in(json, "gaps");
  asked.preview = switch_in(json, "preview");
  asked.row = count_in(json, "row");
  asked.file = text_in(json, "file").value_or("");
  asked.replace = switch_in(json, "replace");
  return asked;
}

}  // namespace kinemend::cli
