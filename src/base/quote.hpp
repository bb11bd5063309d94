#pragma once

#include <string>
#include <string_view>

namespace kinemend {

/// What a file holds at some place, for a message: printable ASCII (a dot for the rest), quoted,
/// cut at 40 characters; `the end of the file` when it is empty.
std::string quote(std::string_view found);

}  // namespace kinemend
