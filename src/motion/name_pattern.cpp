// Matches names with patterns: with or without the subject, ignoring case if no name matches
// exactly.
#include "motion/name_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "kinemend/error.hpp"
#include "kinemend/experimental/letter_case.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/experimental/wildcards.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

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

}  // namespace kinemend
