// Notes the number that a file gives to its first frame.
#pragma once

#include "kinemend/take.hpp"

namespace kinemend {

/// Puts the number that a file gives to its first frame among the facts of the clip's source, where
/// it is a whole number other than 1.
void note_first_frame(Take& clip, double number);

}  // namespace kinemend
