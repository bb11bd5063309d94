// Frames as people count them: frame f of a clip has the number `first_frame_number` + f.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kinemend/take.hpp"

namespace kinemend {

/// Returns the number of frame `frame` (from 0) in a take whose first frame has the number `first`.
std::int64_t frame_number(std::size_t frame, std::int64_t first);

}  // namespace kinemend
