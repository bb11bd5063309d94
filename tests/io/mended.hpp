// Tells whether a reader repaired a file in a way that changes the bytes that are written.
#pragma once

#include "kinemend/error.hpp"

namespace kinemend::test {

/// Returns whether the reader's repairs may change the written bytes: a number was not finite,
/// numbers had no blank between them, or the file ended within a line.
inline bool was_mended(const Diagnostics& repairs) {
  for (const char* name : {"value_not_finite", "frame_time_unusable", "missing_not_finite",
                           "analog_not_finite", "parameter_not_finite", "event_time_not_finite",
                           "head_not_finite", "numbers_joined", "file_cut"}) {
    if (repairs.count(name) > 0) return true;
  }
  return false;
}

}  // namespace kinemend::test
