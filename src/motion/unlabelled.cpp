// Compares a name with the names that capture systems give to unlabelled points.
#include "motion/unlabelled.hpp"
#include "kinemend/experimental/letter_case.hpp"

#include <string>

namespace kinemend {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Returns the name in lower case, without the number at its end.
std::string stem_of(std::string_view name) {
  while (!name.empty() && is_digit(name.back())) name.remove_suffix(1);
  return lower_case(name);
}

}  // namespace

bool is_unlabelled(std::string_view name) {
  if (const std::size_t colon = name.rfind(':'); colon != name.npos) name.remove_prefix(colon + 1);
  if (name.find_first_not_of(' ') == name.npos) return true;
  const std::string stem = stem_of(name);
  if (stem.starts_with("unlabel") || stem == "*" || stem == "uname*") return true;
  return stem == "u_" && stem.size() < name.size();
}

}  // namespace kinemend
