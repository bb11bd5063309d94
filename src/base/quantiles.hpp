// Medians, quantiles, and their values for normal numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinemend {

/// Factor from the median size of normal numbers of mean 0, or a median absolute deviation, to
/// their standard deviation: 1 / Phi^-1(3/4). By definition.
inline constexpr double deviations_per_median = 1.482602218505602;
/// Median length of a vector of three independent standard normal components: the root of the
/// median of the chi-squared distribution of three degrees of freedom. By definition.
inline constexpr double median_of_chi3 = 1.5381722544550522;

/// The value of rank `rank` (below the number of values). Reorders the values: those before it are
/// not larger, those after it not smaller.
inline double of_rank(std::vector<double>& values, std::size_t rank) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The value that a share (0..1) of the values do not exceed; 0 for no values. Reorders them.
inline double quantile_of(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  return of_rank(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// The median, for an even number the lower of the two middle values; 0 for no values. Reorders
/// them.
inline double median_of(std::vector<double>& values) { return quantile_of(values, 0.5); }
/// The same with the upper of the two middle values.
inline double upper_median_of(std::vector<double>& values) {
  return values.empty() ? 0 : of_rank(values, values.size() / 2);
}

/// Returns the percentile by linear interpolation between order statistics, as NumPy does by
/// default; `percentile` is in [0, 100]. Returns 0 for no values.
inline double percentile_of(std::vector<double> values, double percentile) {
  if (values.empty()) return 0;
  const double position = percentile / 100 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double low = of_rank(values, below);
  const auto above = values.begin() + static_cast<std::ptrdiff_t>(below) + 1;
  if (above == values.end()) return low;
  const double high = *std::min_element(above, values.end());
  return low + (position - static_cast<double>(below)) * (high - low);
}

}  // namespace kinemend
