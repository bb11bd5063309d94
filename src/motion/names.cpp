// Matches names with patterns: with or without the subject, ignoring case if no name matches
// exactly. Renames joints or markers by a map, and groups markers by the subject in their names.
#include "motion/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

std::string_view subject_part(std::string_view name) {
  return name.substr(0, name.size() - without_subject(name).size());
}

namespace {

bool is_meant(const std::string& name, const std::string& pattern) {
  return name == pattern || matches_wildcards(pattern, name);
}

bool mark(const std::vector<std::string>& names, const std::string& pattern,
          std::vector<std::uint8_t>& marks) {
  bool any = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_meant(names[i], pattern) && !is_meant(std::string(without_subject(names[i])), pattern))
      continue;
    marks[i] = 1;
    any = true;
  }
  return any;
}

}  // namespace

std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::string& pattern) {
  std::vector<std::uint8_t> marks(names.size(), 0);
  if (mark(names, pattern, marks)) return marks;
  std::vector<std::string> lower;
  lower.reserve(names.size());
  for (const std::string& name : names) lower.push_back(lower_case(name));
  mark(lower, lower_case(pattern), marks);
  return marks;
}

std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::vector<std::string>& patterns,
                                      std::string_view kind) {
  std::vector<std::uint8_t> meant(names.size(), patterns.empty() ? 1 : 0);
  for (const std::string& pattern : patterns) {
    const std::vector<std::uint8_t> marks = names_meant(names, pattern);
    if (std::find(marks.begin(), marks.end(), 1) == marks.end()) {
      throw Error(ErrorKind::usage,
                  fmt::format("no {} matches \"{}\" (the {}s are {})", kind,
                              printable_name(pattern), kind, fmt::join(names, ", ")));
    }
    for (std::size_t i = 0; i < names.size(); ++i) meant[i] |= marks[i];
  }
  return meant;
}

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
  return known.find(':') == known.npos ? std::string(subject_part(name)) + known : known;
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

std::vector<Subject> subjects_of(const Take& clip) {
  std::vector<Subject> subjects;
  Subject nobody, all;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (!clip.holds_positions(m)) continue;
    all.markers.push_back(m);
    std::string_view name = subject_part(clip.names[m]);
    if (!name.empty()) name.remove_suffix(1);
    if (name.empty()) {
      nobody.markers.push_back(m);
      continue;
    }
    auto found = std::find_if(subjects.begin(), subjects.end(),
                              [&](const Subject& subject) { return subject.name == name; });
    if (found == subjects.end()) found = subjects.insert(found, {std::string(name), {}});
    found->markers.push_back(m);
  }
  if (all.markers.empty()) return {};
  if (subjects.size() < 2) return {all};
  if (!nobody.markers.empty()) subjects.push_back(std::move(nobody));
  return subjects;
}

Subject largest_subject(const Take& clip) {
  std::vector<Subject> subjects = subjects_of(clip);
  const auto largest = std::max_element(
      subjects.begin(), subjects.end(),
      [](const Subject& a, const Subject& b) { return a.markers.size() < b.markers.size(); });
  return largest == subjects.end() ? Subject{} : std::move(*largest);
}

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Returns the name in lower case, without the number at its end.
std::string stem_of(std::string_view name) {
  while (!name.empty() && is_digit(name.back())) name.remove_suffix(1);
  return lower_case(name);
}

}  // namespace

bool is_unlabelled(std::string_view name) {
  name = without_subject(name);
  if (name.find_first_not_of(' ') == name.npos) return true;
  const std::string stem = stem_of(name);
  if (stem.starts_with("unlabel") || stem == "*" || stem == "uname*") return true;
  return stem == "u_" && stem.size() < name.size();
}

}  // namespace kinemend
