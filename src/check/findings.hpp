#pragma once

#include <cstddef>
#include <vector>

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

/// The middle of values, by reordering them; 0 for none.
double median_of(std::vector<double>& values);
/// The value that `share` (0..1) of them do not exceed, by reordering them; 0 for none.
double quantile_of(std::vector<double>& values, double share);

}  // namespace kinemend::check
