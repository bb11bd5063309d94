// Recognises points that have a number from the capture system in place of a label.
#pragma once

#include <string_view>

namespace kinemend {

/// Whether the name of a marker is only a number given by the capture system, with or without a
/// subject: `*52`, `U_12`, `uname*3`, `Unlabeled 1234`, or no name at all. Such a point changes
/// from one marker to another within a take.
bool is_unlabelled(std::string_view name);

}  // namespace kinemend
