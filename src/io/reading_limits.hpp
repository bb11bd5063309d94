// Limits on what readers accept from a file: the memory that its take needs, and its frame rate.
// Runs pieces of a file in parallel so that the same file always gives the same error.
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include "base/parallel.hpp"

namespace kinemend {

/// The most memory that a take may need. A file that needs more is hostile, such as one channel and
/// 10,000 fixed joints, or a hundred markers in rows that are almost empty.
inline std::size_t memory_limit(std::size_t file_bytes) {
  return (std::size_t{16} << 20) + 24 * file_bytes;
}

/// Returns the message of the repair `frame_rate_unusable`, for a rate that a take cannot have.
std::string unusable_rate_text(double stated_hz);

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
