// Declares the steps around the Wiener filter: the detection of dense outliers, the guard that
// compares the filter with others, and the fourth differences from which they learn the noise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "methods/wiener/wiener_filter.hpp"

namespace kinemend {

/// Variance of the fourth difference of white noise of variance 1; that of motion is small. By
/// definition: 1 + 16 + 36 + 16 + 1.
inline constexpr double fourth_difference_variance = 70;

/// Calls `visit(y_f - 4 y_(f-1) + 6 y_(f-2) - 4 y_(f-3) + y_(f-4))` for each frame f of a channel
/// if all five samples are used, as `is_used(index in y.values)` says.
template <class IsUsed, class Visit>
void for_each_fourth_difference(const PoseMatrix& y, std::size_t channel, const IsUsed& is_used,
                                const Visit& visit) {
  std::size_t run = 0;
  for (std::size_t f = 0; f < y.frames; ++f) {
    run = is_used(f * y.channels + channel) ? run + 1 : 0;
    if (run < 5) continue;
    visit(y(f, channel) - 4 * y(f - 1, channel) + 6 * y(f - 2, channel) - 4 * y(f - 3, channel) +
          y(f - 4, channel));
  }
}

struct WienerOutliers {
  std::vector<std::uint8_t>
      suspect;       ///< F x D, 1 for outliers; shared by the three channels of a track
  PoseMatrix guess;  ///< F x D, for samples that are missing or suspect
};

/// Detects dense outliers (a tenth of the samples or more). The take is filtered as if outliers
/// were noise, of the variance of its fourth differences; samples far from the result, relative to
/// the median distance, are bridged; this is repeated with the remaining noise. Starts from
/// `take.suspect` and `take.guess`.
WienerOutliers dense_outliers(const WienerPrior& prior, const WienerTake& take);

/// Runs `wiener_filter` and limits its error on motion unlike the training. For each three channels
/// it is mixed with the take smoothed as `auto` smooths tracks, in the shares of least risk; then
/// the Gaussian of the best width replaces it if its risk is clearly smaller. Tracks with many
/// missing samples keep the filter's result.
///
/// The risk of a filter on a channel is Stein's unbiased estimate of the squared error, summed over
/// the samples used,
///
///     sum_t (y_t - x_t)^2 - v + 2 v d x_t / d y_t
///
/// for noise of variance v. A probe estimates the divergence of `wiener_filter`: the take is
/// filtered once more with a random sign of a tenth of the noise added to each sample.
WienerResult guarded_wiener_filter(const WienerPrior& prior, const WienerTake& take,
                                   const WienerSettings& settings = {});

}  // namespace kinemend
