#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinemend {

/// The value that `share` (0..1) of them do not exceed, by reordering them; 0 for none.
inline double quantile_of(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// The middle of values, by reordering them; 0 for none.
inline double median_of(std::vector<double>& values) { return quantile_of(values, 0.5); }

}  // namespace kinemend
