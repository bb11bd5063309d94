// Counts parts of texts, for tests of reports.
#pragma once

#include <cstddef>
#include <string>

namespace kinemend::test {

/// Counts the occurrences of a part.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace kinemend::test
