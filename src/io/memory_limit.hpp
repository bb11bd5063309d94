#pragma once

#include <cstddef>

namespace kinemend {

/// A take needs no more memory than this; what claims to is a hostile file, such as one channel and
/// 10,000 fixed joints, or a hundred markers of which all but a few rows hold nothing.
inline std::size_t memory_limit(std::size_t file_bytes) {
  return (std::size_t{16} << 20) + 24 * file_bytes;
}

}  // namespace kinemend
