// Lines between markers, which make them look like a body instead of a cloud of dots.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::page {

/// Returns pairs of markers to connect by a line, lower index first, in a fixed order. Markers on
/// one bone keep their distance, and across a joint it changes little: the shortest and steadiest
/// pairs are taken until every group of markers is connected, without a loop. Markers that are too
/// far apart for the body, drift apart, or are rarely observed together are not linked. Uses at
/// most 120 frames. `body_height`: in the clip's unit, above 0.
std::vector<std::array<std::size_t, 2>> marker_links(const Take& clip, double body_height);

}  // namespace kinemend::page
