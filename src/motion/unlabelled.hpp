// Recognises points that have a number from the capture system in place of a label.
#pragma once

#include <string_view>

namespace kinemend {

/// Whether a marker bears no label but a number that the capture system gave it, with or without a
/// subject: `*52`, `U_12`, `uname*3`, `Unlabeled 1234`, or no name at all. Such a point changes
/// from one marker to another within a take.
bool is_unlabelled(std::string_view name);

}  // namespace kinemend
