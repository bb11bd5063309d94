// Compares names exactly first and then without regard to case.
#include "matching_choice.hpp"

#include <algorithm>

#include "kinemend/extend/text.hpp"

namespace kinemend::cli {

std::string matching_choice(std::string_view name, const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), name) != choices.end()) return std::string(name);
  const auto is_meant = [&](const std::string& choice) { return same_but_for_case(choice, name); };
  const auto found = std::find_if(choices.begin(), choices.end(), is_meant);
  const bool is_only =
      found != choices.end() && std::find_if(found + 1, choices.end(), is_meant) == choices.end();
  return is_only ? *found : std::string(name);
}

}  // namespace kinemend::cli
