// Fourth differences of channels, which contain the noise and hardly any motion.
#pragma once

#include <cstddef>

#include "kinemend/experimental/pose_matrix.hpp"

namespace kinemend::signal {

/// The number of earlier frames that a fourth difference needs. By definition.
constexpr std::size_t fourth_difference_span = 4;
/// Variance of the fourth difference of white noise of variance 1; that of motion is small. By
/// definition: 1 + 16 + 36 + 16 + 1.
constexpr double fourth_difference_variance = 70;

/// y_f - 4 y_(f-1) + 6 y_(f-2) - 4 y_(f-3) + y_(f-4) of a channel; f is 4 or more.
inline double fourth_difference(const PoseMatrix& y, std::size_t f, std::size_t channel) {
  return y(f, channel) - 4 * y(f - 1, channel) + 6 * y(f - 2, channel) - 4 * y(f - 3, channel) +
         y(f - 4, channel);
}

}  // namespace kinemend::signal
