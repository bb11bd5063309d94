// Bytes on the heap, for laws about memory. `counting_allocation.hpp` counts them in the programs
// that include it once; they stay zero where a sanitizer counts itself.
#pragma once

#include <atomic>
#include <cstddef>

namespace kinemend::test {

inline std::atomic<std::size_t> memory_now{0}, memory_peak{0};
inline std::atomic<std::size_t> memory_taken{0};  ///< ever, freed or not

/// Most memory that `action` held at once beyond what was held before.
template <class Action>
std::size_t peak_memory(Action&& action) {
  const std::size_t before = memory_now;
  memory_peak = before;
  action();
  return memory_peak - before;
}

}  // namespace kinemend::test
