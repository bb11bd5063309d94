// Notes the number that a file gives to its first frame.
#pragma once

#include "kinemend/take.hpp"

namespace kinemend {

/// Adds the number that a file gives to its first frame to the facts of the clip's source, if it is
/// a whole number other than 1.
void note_first_frame(Take& clip, double number);

}  // namespace kinemend
