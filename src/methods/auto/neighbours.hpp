// Finds the tracks that move together with a track: nearby joints, or markers of the same segment.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/take_view.hpp"

namespace kinemend {

/// For each of `tracks`, the indices in that list of the others that move with it. Rotations: the
/// joints near it on the body. Markers: up to four others that keep their distance to it, nearest
/// first: within 0.3 body heights, and usually constant to a 50th of one, in at most 50 frames.
/// Positions of joints: none.
std::vector<std::vector<std::size_t>> tracks_nearby(const TakeView& take,
                                                    const std::vector<std::size_t>& tracks);

}  // namespace kinemend
