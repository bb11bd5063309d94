#pragma once

#include <cstddef>

#include "io/text/text.hpp"

namespace kinemend {

/// The rate that a file states, where a take may have it (`frame_rate.hpp`); else 0, which is
/// unknown. One that is out of range, and not just missing, is the repair `frame_rate_unusable`.
double usable_rate(const SourceText& text, Diagnostics& diagnostics, double stated_hz,
                   std::size_t place);

/// The words of that repair.
std::string unusable_rate_text(double stated_hz);

}  // namespace kinemend
