#pragma once

#include "priors/wiener_filter.hpp"

namespace kinemend {

/// What a filter risks on each channel, and what plain Gaussians would: Stein's unbiased estimate
/// of the squared error summed over the samples that count,
///
///     sum_t (y_t - x_t)^2 - v + 2 v d x_t / d y_t
///
/// for noise of variance v. The divergence of `wiener_filter` is measured by a probe: the take is
/// filtered once more with a random sign of a tenth of the noise added to each sample.
///
/// `wiener_filter`, mixed for each three channels with what `smooth_channels` makes of the take in
/// the shares that risk the least, and for each three channels
/// on which the Gaussian of the best width risks clearly less, that Gaussian: motion unlike all
/// that was learned does not suffer from it. Parts of which much is missing are left to the filter.
WienerResult guarded_wiener_filter(const WienerPrior& prior, const WienerTake& take,
                                   const WienerSettings& settings = {});

}  // namespace kinemend
