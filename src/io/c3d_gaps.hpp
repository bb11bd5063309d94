#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// Frames [first, last) in which a marker stands at the origin because it is missing.
struct C3dZeroGap {
  std::size_t marker = 0;
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Finds the samples at exactly 0, 0, 0 that no marker can have been at: a marker that is there in
/// every frame of several, or that would have to jump there from farther away, or back, than 20
/// times the step that it usually makes from frame to frame (at least 20 `resolution`). A marker
/// that rests at or passes through the origin keeps its samples; so do points that are no
/// positions.
std::vector<C3dZeroGap> find_zero_gaps(const MarkerClip& clip, double resolution);

/// Makes them missing.
void apply_zero_gaps(const std::vector<C3dZeroGap>& gaps, MarkerClip& clip);

}  // namespace kinemend
