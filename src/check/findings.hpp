#pragma once

#include <cstddef>
#include <vector>

#include "base/quantiles.hpp"
#include "kinemend/check.hpp"

namespace kinemend::check {

/// Frames [first, last].
struct Span {
  std::size_t first = 0;
  std::size_t last = 0;

  std::size_t length() const noexcept { return last - first + 1; }
};

/// Serious ones first, then by kind, figure, frame and track.
void sort_worst_first(std::vector<Finding>& findings);

}  // namespace kinemend::check
