// Compares names exactly first and then without regard to case.
#include "matching_choice.hpp"

#include <algorithm>

namespace kinemend::cli {

namespace {

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

}  // namespace

std::string matching_choice(std::string_view name, const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), name) != choices.end()) return std::string(name);
  const auto is_meant = [&, wanted = lower_case(name)](const std::string& choice) {
    return lower_case(choice) == wanted;
  };
  const auto found = std::find_if(choices.begin(), choices.end(), is_meant);
  const bool is_only =
      found != choices.end() && std::find_if(found + 1, choices.end(), is_meant) == choices.end();
  return is_only ? *found : std::string(name);
}

}  // namespace kinemend::cli
