// Lines between markers, so that they look like a body and not like a cloud of dots.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::page {

/// Pairs of markers to draw a line between, lower index first, in a fixed order. Markers on one
/// bone keep their distance, and across a joint it changes little: of such pairs the shortest and
/// steadiest are taken until every group of markers is connected, without a loop. Markers that are
/// far apart for the body, drift apart, or are rarely observed together are not linked.
/// Looks at 120 frames at most. `body_height`: in the clip's unit, above 0.
std::vector<std::array<std::size_t, 2>> marker_links(const Take& clip, double body_height);

}  // namespace kinemend::page
