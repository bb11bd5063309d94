// Names and words without regard to case.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// Converts A to Z to a to z, whatever the locale, and keeps every other byte.
char lower_case(char letter);
std::string lower_case(std::string_view text);
/// Whether two texts are equal except for case (ASCII).
bool same_but_for_case(std::string_view a, std::string_view b);

}  // namespace kinemend
