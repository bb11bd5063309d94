#pragma once

#include <cstddef>
#include <vector>

#include "clean/marker_tracks.hpp"

namespace kinemend {

/// One marker over the whole take. Gaps hold a smooth curve on which nothing stands out: bridges
/// where they are short; in long ones the movement at either end dies away within about 0.1 s.
struct WholeMarker {
  std::size_t marker = 0;
  std::vector<Vec3> positions;  ///< F
};

/// The selected markers that were seen at all, in their order.
std::vector<WholeMarker> whole_markers(const MarkerClip& clip, const MarkerSelection& selection);

}  // namespace kinemend
