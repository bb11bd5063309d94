// A bound on how deeply JSON from outside may be nested. Every reader of JSON uses it.
#pragma once

#include <cstddef>
#include <string_view>

namespace kinemend {

/// The most levels of arrays and objects, one inside the other, that are read. Files of the program
/// have five.
inline constexpr std::size_t deepest_json = 64;

/// `text` up to the bracket that opens a level deeper than `deepest_json`; the whole text where
/// there is none. A parser meets the end there, and reports it as it reports any text that is cut.
/// Takes time linear in the text and no memory. Never throws.
std::string_view json_within_depth(std::string_view text);

/// `Json::parse` of text from outside. Code that walks through a value calls itself for every
/// level, and a value that is nested deeply enough would exhaust the stack.
/// `Json`: `nlohmann::json` or `nlohmann::ordered_json`. Errors: `Json::parse_error`, whose `byte`
/// is the place; a discarded value instead where `throws` is false.
template <class Json>
Json parse_json(std::string_view text, bool throws = true) {
  return Json::parse(json_within_depth(text), nullptr, throws);
}

}  // namespace kinemend
