// Treats motion that the learned bases do not express: it is smoothed, or left to `auto`.
#pragma once

#include <vector>

#include "methods/prior/prior_cleaning.hpp"

namespace kinemend {

/// Standard deviation of each channel's noise (D, degrees, at least 0.05) as `auto` measures it;
/// channels without a measured noise get the typical one.
std::vector<double> example_noise(const PriorWork& work);

/// How many times as much of the take lies outside the bases as of the clips that they were learned
/// from: mean squares of `guess` less `expressed` (the part that the bases express), without the
/// noise, over those in training (`residual`, D, cross-validated). At least 1.
double strangeness(const PriorWork& work, const PoseMatrix& guess, const PoseMatrix& expressed,
                   const std::vector<double>& noise, const std::vector<double>& residual);

/// Smooths the motion outside the bases, which is smooth, too: the measurements less the part that
/// the bases express are smoothed by their own evidence, without the samples that the filter
/// rejected (`weights`, F x D), and added to that part. `cleaned` is the filter's result,
/// `expressed` the part of it that the bases express.
void smooth_rest(const PriorWork& work, const PoseMatrix& weights, const PoseMatrix& expressed,
                 const std::vector<double>& noise, PoseMatrix& cleaned);

/// Replaces measured samples by `auto`'s result, the more the stranger the take: not at all below a
/// strangeness of 1.5, wholly from 5 on. Gaps keep the fill of the bases.
void fall_back(PriorWork& work, double strangeness, PoseMatrix& cleaned);

/// Falls back to `auto` where the filter is biased. Measurements scatter about the true motion:
/// where the median of a part's residuals within a fifth of a second (15 frames at least) is far
/// from zero, the motion is the bases', not the take's. `auto` begins to replace the part at one
/// deviation of the noise and has replaced it at two.
void fall_back_where_biased(PriorWork& work, const std::vector<double>& noise, PoseMatrix& cleaned);

}  // namespace kinemend
