// The order of findings in a report.
#pragma once

#include <cstddef>
#include <vector>

#include "base/frame_span.hpp"
#include "base/quantiles.hpp"
#include "kinemend/check.hpp"

namespace kinemend::check {

/// Serious ones first, then by kind, figure, frame and track.
void sort_worst_first(std::vector<Finding>& findings);

}  // namespace kinemend::check
