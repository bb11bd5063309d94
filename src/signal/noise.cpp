#include <fmt/format.h>

#include <cmath>

#include "kinemend/signal.hpp"
#include "signal/checks.hpp"
#include "signal/order_statistics.hpp"

namespace kinemend {

std::vector<double> estimate_noise(const PoseMatrix& matrix, int difference_order) {
  signal::require(difference_order >= 1 && difference_order <= 10,
                  fmt::format("difference order {} is outside 1 to 10", difference_order));
  const auto order = static_cast<std::size_t>(difference_order);
  std::vector<double> noise(matrix.channels, 0.0);
  if (matrix.frames <= order) return noise;

  // White noise of variance 1 has differences of variance binomial(2k, k), the sum of the squared
  // binomials.
  double variance = 1;
  for (std::size_t k = 1; k <= order; ++k) {
    variance *= static_cast<double>(order + k) / static_cast<double>(k);
  }
  const double scale = signal::mad_to_sigma / std::sqrt(variance);
  signal::for_each_column(matrix.values.data(), matrix.frames, matrix.channels,
                          [&](std::size_t channel, std::span<double> values) {
                            std::size_t count = values.size();
                            for (std::size_t k = 0; k < order; ++k, --count) {
                              for (std::size_t t = 0; t + 1 < count; ++t)
                                values[t] = values[t + 1] - values[t];
                            }
                            noise[channel] = scale * signal::median_deviation(values.first(count));
                          });
  return noise;
}

}  // namespace kinemend
