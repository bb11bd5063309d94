// Guards `wiener` against motion unlike its training: simple smoothers take over where their
// estimated risk is smaller.
#pragma once

#include "learned/wiener/wiener_filter.hpp"

namespace kinemend {

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
