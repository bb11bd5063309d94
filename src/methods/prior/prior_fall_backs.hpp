// Limits what a learned model changes: a part changes no further than its noise justifies, and
// motion that the model does not express is smoothed or left to `auto`. Notes what was left to
// `auto`, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "methods/prior/prior_cleaning.hpp"

namespace kinemend {

/// Notes that `shares` (D / 3, 0..1) of each part are now `auto`'s result, and reduces the shares
/// noted before accordingly.
void add_fall_back(PriorWork& work, std::string reason, std::vector<double> shares);

/// Whether most of a part is `auto`'s result; its actions are then those of `auto`.
bool is_fallen_back(const PriorWork& work, std::size_t part);

/// The noted shares by joint or marker, and the tracks that the model does not know. `selected`:
/// one flag per joint or marker; `place`: whether the root position, the part behind the layout's,
/// is selected.
std::vector<FallBack> fall_backs_of(const PriorWork& work,
                                    const std::vector<std::uint8_t>& selected, bool place);

/// Share of the measurements that `auto` takes for spikes, or that are far from `result` (F x D)
/// while most of their channel are not.
double suspect_share(const PriorWork& work, const PoseMatrix& result);

/// Before the filter: sets the need of each part. It is whole if `hold` is nothing, or if one
/// sample in fifty is a spike to `auto` or far from `auto`'s result. It is zero (the filter may
/// still fill gaps) if the filter takes noise for white and `auto` finds coloured noise or frames
/// repeated from a lower rate. Otherwise `work.needs` stays.
void settle_needs(PriorWork& work, PriorHold hold);

/// Called by a filter that finds this share of the measurements to be outliers. Above one in fifty
/// the filter's result is not held near `auto`'s, which may have taken the outliers for noise.
/// Parts that need nothing of the filter stay `auto`'s.
void release_if_crowded(PriorWork& work, double outliers);

/// Blends `auto`'s result into the filter's by 1 - need for each part (`work.needs`): a part that
/// `auto` finds clean keeps `auto`'s result. The filter's fill of a gap moves with the samples
/// beside it. A sample that is farther from `auto`'s than the noise's deviation (of all three axes)
/// is put at that distance.
void hold_to_needs(PriorWork& work);

/// A mark for each part of the model's layout (N): 1 if the filter affects it, by need or, with
/// `fill`, by gaps. Parts that the take lacks, or that are left out, have 0.
std::vector<std::uint8_t> wanted_parts(const PriorWork& work, bool fill);

/// Whether the filter does not affect a part: no need, and nothing that it may fill.
bool is_left_alone(const PriorWork& work, std::size_t part, bool fill);

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
