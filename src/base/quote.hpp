// Quotes text from a file in a message.
#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// What a file holds at some place, for a message: in quotes, at most 40 characters of it, with a
/// dot for what is no UTF-8 or would command a terminal; `the end of the file` when it is empty.
std::string quote(std::string_view found);

}  // namespace kinemend
