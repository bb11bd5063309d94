// Splits a range of frames into blocks that run in parallel.
#pragma once

#include <cstddef>

#include "base/parallel.hpp"

namespace kinemend::feet {

/// Calls work(first, end) for blocks that together are [first, end), in any order and in several
/// threads.
template <class Work>
void for_blocks(std::size_t first, std::size_t end, const Work& work) {
  // For speed, not swept.
  constexpr std::size_t least = 256;  // frames, a share of work
  for_each_range(first, end, least, work);
}

}  // namespace kinemend::feet
