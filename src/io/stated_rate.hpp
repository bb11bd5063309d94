// Decides whether the frame rate that a file states can be used.
#pragma once

#include <cstddef>

#include "io/text/text.hpp"

namespace kinemend {

/// Returns the rate that a file states if a take can have it (`frame_rate.hpp`), else 0 for
/// unknown. A rate out of range is the repair `frame_rate_unusable`; a missing rate is not.
double usable_rate(const SourceText& text, Diagnostics& diagnostics, double stated_hz,
                   std::size_t place);

/// Returns the message of that repair.
std::string unusable_rate_text(double stated_hz);

}  // namespace kinemend
