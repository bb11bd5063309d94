#pragma once

#include <cstddef>

#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// What was found by `mark_zeros_missing`.
struct MissingZeros {
  std::size_t samples = 0;
  std::size_t first_frame = 0;  ///< of the first of them
};

/// Many programs write 0 0 0 where a marker was not seen. Samples at exactly the origin become
/// missing, unless the marker is really there: a sample beside their run lies within 5 cm of the
/// origin (in millimetres where the clip names no unit that is known).
MissingZeros mark_zeros_missing(MarkerClip& clip);

}  // namespace kinemend
