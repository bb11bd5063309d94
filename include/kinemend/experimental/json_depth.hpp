// Limits how deeply JSON from outside may be nested. Every reader of JSON uses it.
#pragma once

#include <cstddef>
#include <string_view>

namespace kinemend {

/// The largest accepted depth of nested arrays and objects. Files of the program have five levels.
inline constexpr std::size_t deepest_json = 64;

/// Returns `text` up to the bracket that opens a level deeper than `deepest_json`, else the whole
/// text. A parser reports the result as it reports any truncated text. Takes linear time and no
/// memory. Never throws.
std::string_view json_within_depth(std::string_view text);

/// Parses text from outside with `Json::parse`. Code that walks through a value recurses for every
/// level, so a deeply nested value would exhaust the stack. `Json`: `nlohmann::json` or
/// `nlohmann::ordered_json`. Errors: `Json::parse_error`, whose `byte` is the position; returns a
/// discarded value instead if `throws` is false.
template <class Json>
Json parse_json(std::string_view text, bool throws = true) {
  return Json::parse(json_within_depth(text), nullptr, throws);
}

}  // namespace kinemend
