// Splits a range of frames into blocks that run in parallel.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace kinemend::feet {

/// work(first, end) for blocks that together are [first, end), in any order and in several threads.
template <class Work>
void for_blocks(std::size_t first, std::size_t end, const Work& work) {
  constexpr std::size_t least = 256;  // frames, a share of work
  tbb::parallel_for(tbb::blocked_range<std::size_t>(first, end, least),
                    [&](const auto& block) { work(block.begin(), block.end()); });
}

}  // namespace kinemend::feet
