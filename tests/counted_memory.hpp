// Counts bytes on the heap, for tests of memory use. A program counts if one of its sources
// includes `counting_allocation.hpp`; the counts stay zero under a sanitizer with its own counting.
#pragma once

#include <atomic>
#include <cstddef>

namespace kinemend::test {

inline std::atomic<std::size_t> memory_now{0}, memory_peak{0};
inline std::atomic<std::size_t> memory_taken{0};  ///< total ever allocated, freed or not

/// Peak memory of `action` beyond the amount held before it.
template <class Action>
std::size_t peak_memory(Action&& action) {
  const std::size_t before = memory_now;
  memory_peak = before;
  action();
  return memory_peak - before;
}

}  // namespace kinemend::test
