// Renames joints or markers by a map of names.
#include "kinemend/skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kinemend/error.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/take.hpp"
#include "motion/name_pattern.hpp"

namespace kinemend {

namespace {

std::size_t part_called(const std::vector<std::string>& names, const std::string& name) {
  const auto same = std::find(names.begin(), names.end(), name);
  if (same != names.end()) return static_cast<std::size_t>(same - names.begin());
  const std::vector<std::uint8_t> meant = names_meant(names, name);
  const auto count = std::count(meant.begin(), meant.end(), 1);
  if (count == 1)
    return static_cast<std::size_t>(std::find(meant.begin(), meant.end(), 1) - meant.begin());
  throw Error(ErrorKind::usage,
              count == 0 ? fmt::format("names: the take has no \"{}\" (it has {})",
                                       printable_name(name), fmt::join(names, ", "))
                         : fmt::format("names: \"{}\" is the name of {} parts of the take",
                                       printable_name(name), count));
}

/// Adds the subject of the joint or marker, unless the known name has its own.
std::string with_subject(const std::string& known, const std::string& name) {
  const std::size_t subject = name.size() - without_subject(name).size();
  return known.find(':') == known.npos ? name.substr(0, subject) + known : known;
}

}  // namespace

std::vector<std::string> known_names(const std::vector<std::string>& names, const KnownNames& map) {
  std::vector<std::string> known(names.size());
  for (const auto& [name, part] : map) {
    if (!part.empty()) known[part_called(names, part)] = name;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!known[i].empty()) {
      known[i] = with_subject(known[i], names[i]);
    } else if (map.find(names[i]) == map.end() &&
               map.find(without_subject(names[i])) == map.end()) {
      known[i] = names[i];
    } else {
      known[i] = fmt::format("part {}", i + 1);
    }
  }
  return known;
}

}  // namespace kinemend
