#pragma once

#include <atomic>
#include <cstddef>

// How much memory an action takes. The counting operators of `counted_operators.hpp` are part of
// those programs that ask.
namespace kinemend::test {

/// Bytes on the heap; zero where a sanitizer counts itself.
inline std::atomic<std::size_t> memory_now{0}, memory_peak{0};

/// Most memory that `action` held at once beyond what was held before.
template <class Action>
std::size_t peak_memory(Action&& action) {
  const std::size_t before = memory_now;
  memory_peak = before;
  action();
  return memory_peak - before;
}

}  // namespace kinemend::test
