#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "priors/wiener_filter.hpp"

namespace kinemend {

/// Smooths channels in place by nothing but their own evidence. `missing` is F x D, 1 where a
/// sample has no weight; `noise` D, standard deviations, degrees.
using TakeSmoother = std::function<void(PoseMatrix& poses, std::span<const std::uint8_t> missing,
                                        std::span<const double> noise)>;

/// What a filter risks on each channel, and what plain Gaussians would: Stein's unbiased estimate
/// of the squared error summed over the samples that count,
///
///     sum_t (y_t - x_t)^2 - v + 2 v d x_t / d y_t
///
/// for noise of variance v. The divergence of `wiener_filter` is measured by a probe: the take is
/// filtered once more with a random sign of a tenth of the noise added to each sample.
///
/// `wiener_filter`, mixed for each three channels with what `smoother` makes of the take in the
/// shares that risk the least (empty: not mixed), and for each three channels
/// on which the Gaussian of the best width risks clearly less, that Gaussian: motion unlike all
/// that was learned does not suffer from it. Parts of which much is missing are left to the filter.
WienerResult guarded_wiener_filter(const WienerPrior& prior, const WienerTake& take,
                                   const TakeSmoother& smoother = {},
                                   const WienerSettings& settings = {});

}  // namespace kinemend
