// Repairs numbers that have no blank between them.
#pragma once

#include <string_view>
#include <vector>

#include "io/motion/motion_document.hpp"

namespace kinemend {

/// The message of the repair `numbers_joined`.
inline constexpr std::string_view joined_numbers_text =
    "two numbers have no blank between them: the sign starts the second";

/// Inserts a blank at each of the places in the document's bytes, in ascending order, so that every
/// program can read the output. Places behind the frames are ignored.
void separate_numbers(MotionDocument& document, const std::vector<const char*>& places);

}  // namespace kinemend
