// Finds the median of values by selection.
#include "signal/order_statistics.hpp"

#include <algorithm>
#include <memory>

#include "signal/kernels.hpp"

namespace kinemend::signal {

double median(std::span<const double> values) {
  const std::size_t count = values.size();
  if (count == 0) return 0;
  const std::unique_ptr<double[]> copies(new double[2 * count]);
  std::copy(values.begin(), values.end(), copies.get());
  const Ranked middle = select_rank(copies.get(), count, (count - 1) / 2, copies.get() + count);
  return count % 2 == 1 ? middle.value : (middle.value + middle.next) / 2;
}

}  // namespace kinemend::signal
