// Runs pieces of a file in parallel so that the same file always gives the same error.
#pragma once

#include <cstddef>
#include <exception>
#include <vector>

#include "base/parallel.hpp"

namespace kinemend {

/// Calls `work(i)` for each i below `count`, in parallel. If several calls throw, the exception of
/// the lowest i is rethrown after all calls have ended.
inline void for_each_first_error(std::size_t count, const IndexWork& work) {
  std::vector<std::exception_ptr> errors(count);
  for_each_index(count, [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace kinemend
