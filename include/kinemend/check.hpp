#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/marker_clip.hpp"

// The health of a take before cleaning.
namespace kinemend {

/// Two markers whose labels change places over a span of frames.
struct MarkerSwap {
  std::size_t first_marker = 0;
  std::size_t second_marker = 0;
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
};

/// The spans in which two labels are swapped, as far as the take itself proves it.
std::vector<MarkerSwap> find_swaps(const MarkerClip& clip);
/// Gives the samples of each span to the other marker, in place.
void undo_swaps(MarkerClip& clip, const std::vector<MarkerSwap>& swaps);

}  // namespace kinemend
