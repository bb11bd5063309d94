// Finds the entries of tables that are chosen by their member `name`: methods, trainings, options.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

std::vector<std::string> names_of(const auto& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const auto& entry : entries) names.emplace_back(entry.name);
  return names;
}

/// The entry of that name. Errors: `ErrorKind::usage`: `unknown method "gausian"; did you mean
/// gaussian? (there are ...)` if `unknown` is `unknown method`; `listed` introduces the list.
const auto& find_named(const auto& entries, std::string_view name, std::string_view unknown,
                       std::string_view listed = "there are") {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const auto& entry) { return entry.name == name; });
  if (found != entries.end()) return *found;
  const std::vector<std::string> names = names_of(entries);
  throw Error(ErrorKind::usage,
              fmt::format("{} \"{}\"{} ({} {})", unknown, printable_name(name),
                          suggestion(name, names), listed, fmt::join(names, ", ")));
}

/// The option of a method. Errors: `ErrorKind::usage`, naming `taker` and its options.
inline const OptionSpec& find_option(const std::vector<OptionSpec>& options, std::string_view name,
                                     std::string_view taker) {
  return find_named(options, name, fmt::format("{} has no option", taker), "it takes");
}

}  // namespace kinemend
