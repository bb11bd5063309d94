// Limits on what readers accept from a file: the memory that its take needs, and the frame rate
// that it states.
#pragma once

#include <cstddef>

#include "io/text/text.hpp"

namespace kinemend {

/// The most memory that a take may need. A file that needs more is hostile, such as one channel and
/// 10,000 fixed joints, or a hundred markers in rows that are almost empty.
inline std::size_t memory_limit(std::size_t file_bytes) {
  return (std::size_t{16} << 20) + 24 * file_bytes;
}

/// Returns the rate that a file states if a take can have it (`frame_rate.hpp`), else 0 for
/// unknown. A rate out of range is the repair `frame_rate_unusable`; a missing rate is not.
double usable_rate(const SourceText& text, double stated_hz, std::size_t place);

/// Returns the message of that repair.
std::string unusable_rate_text(double stated_hz);

}  // namespace kinemend
