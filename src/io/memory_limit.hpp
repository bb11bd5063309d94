// The most memory that a take from a file of a given size may need.
#pragma once

#include <cstddef>

namespace kinemend {

/// The most memory that a take may need. A file that needs more is hostile, such as one channel and
/// 10,000 fixed joints, or a hundred markers in rows that are almost empty.
inline std::size_t memory_limit(std::size_t file_bytes) {
  return (std::size_t{16} << 20) + 24 * file_bytes;
}

}  // namespace kinemend
