#include "signal/order_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace kinemend::signal {

double median_in_place(std::span<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

double median_deviation_in_place(std::span<double> values) {
  const double median = median_in_place(values);
  for (double& value : values) value = std::abs(value - median);
  return median_in_place(values);
}

}  // namespace kinemend::signal
