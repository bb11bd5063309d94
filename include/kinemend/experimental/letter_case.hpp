// Names and words without regard to case.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// A to Z as a to z, whatever the locale; every other byte as it is.
char lower_case(char letter);
std::string lower_case(std::string_view text);
/// Whether two texts are equal except for case (ASCII).
bool same_but_for_case(std::string_view a, std::string_view b);

}  // namespace kinemend
