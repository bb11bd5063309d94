// Limits on what readers accept from a file: the memory that its take needs, and its frame rate.
#pragma once

#include <cstddef>
#include <string>

namespace kinemend {

/// The most memory that a take may need. A file that needs more is hostile, such as one channel and
/// 10,000 fixed joints, or a hundred markers in rows that are almost empty.
inline std::size_t memory_limit(std::size_t file_bytes) {
  return (std::size_t{16} << 20) + 24 * file_bytes;
}

/// Returns the message of the repair `frame_rate_unusable`, for a rate that a take cannot have.
std::string unusable_rate_text(double stated_hz);

}  // namespace kinemend
