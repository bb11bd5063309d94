// Treats what a take does that the learned bases do not express: it is smoothed, or left to `auto`.
#pragma once

#include <vector>

#include "learned/core/prior_cleaning.hpp"

namespace kinemend {

/// Standard deviation of each channel's noise (D, degrees, at least 0.05): as `auto` measures it;
/// of channels about which nothing is known the typical one.
std::vector<double> example_noise(const PriorWork& work);

/// How many times as much of the take lies outside of the bases as of the clips that they were
/// learned from: mean squares of `guess` less `expressed`, what the bases make of it, without the
/// noise, over those in training (`residual`, D, cross-validated). At least 1.
double strangeness(const PriorWork& work, const PoseMatrix& guess, const PoseMatrix& expressed,
                   const std::vector<double>& noise, const std::vector<double>& residual);

/// Motion outside of the bases is smooth, too: what is measured less what the bases express is
/// smoothed by its own evidence, without the samples that the filter rejected (`weights`, F x D),
/// and added to what the bases express. `cleaned` is the filter's result, `expressed` what the
/// bases express of it.
void smooth_rest(const PriorWork& work, const PoseMatrix& weights, const PoseMatrix& expressed,
                 const std::vector<double>& noise, PoseMatrix& cleaned);

/// The stranger the take, the more of what `auto` made of its measurements: none of it below a
/// strangeness of 1.5, nothing else from 5 on. Gaps stay as the bases fill them.
void fall_back(PriorWork& work, double strangeness, PoseMatrix& cleaned);

/// What is measured scatters about the motion: where the median of what the filter leaves of a part
/// within a fifth of a second (15 frames at least) is far from zero, the motion is the bases', not
/// the take's. From a deviation of the noise on it becomes what `auto` made of it, wholly at two.
void fall_back_where_biased(PriorWork& work, const std::vector<double>& noise, PoseMatrix& cleaned);

}  // namespace kinemend
