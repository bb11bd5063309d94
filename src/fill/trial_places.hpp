#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fill/curves.hpp"

namespace kinemend::fill {

/// Spans as long as the gap in which all is seen, with a frame on either side: the six nearest to
/// the gap, half a length apart at least, for what moves there; and three evenly over the frames,
/// for what the nearest do not show. Shorter ones (half, a quarter, ...) where there is no room for
/// three; none where there is no room at all. `usable[i]` is about frame `first_frame` + i; 0 in
/// the gap itself.
std::vector<FrameSpan> trial_places(std::span<const std::uint8_t> usable, std::size_t first_frame,
                                    FrameSpan gap);

}  // namespace kinemend::fill
