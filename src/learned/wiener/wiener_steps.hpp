// The steps around the Wiener filter: outliers that are dense, and the guard that compares it with
// others.
#pragma once

#include <cstdint>
#include <vector>

#include "learned/wiener/wiener_filter.hpp"

namespace kinemend {

struct WienerOutliers {
  std::vector<std::uint8_t>
      suspect;       ///< F x D, 1 for outliers; shared by the three channels of a track
  PoseMatrix guess;  ///< F x D, for samples that are missing or suspect
};

/// Detects dense outliers, a tenth of the samples and more: the take is filtered as if outliers
/// were noise, of the variance of its fourth differences; samples far from the result, relative to
/// the median distance, are bridged; and this is repeated with the remaining noise. Starts from
/// `take.suspect` and `take.guess`.
WienerOutliers dense_outliers(const WienerPrior& prior, const WienerTake& take);

/// Risk of a filter on each channel, and of Gaussian filters: Stein's unbiased estimate of the
/// squared error summed over the samples used,
///
///     sum_t (y_t - x_t)^2 - v + 2 v d x_t / d y_t
///
/// for noise of variance v. The divergence of `wiener_filter` is estimated by a probe: the take is
/// filtered once more with a random sign of a tenth of the noise added to each sample.
///
/// `wiener_filter`, mixed for each three channels with what `smooth_channels` makes of the take in
/// the shares that risk the least, and for each three channels
/// on which the Gaussian of the best width has a clearly smaller risk, that Gaussian: this limits
/// the error on motion unlike the training. Tracks with many missing samples keep the filter's
/// result.
WienerResult guarded_wiener_filter(const WienerPrior& prior, const WienerTake& take,
                                   const WienerSettings& settings = {});

}  // namespace kinemend
