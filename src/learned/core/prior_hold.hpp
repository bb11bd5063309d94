// Holds a learned model back: it changes a part no further than the noise of the part asks for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "learned/core/prior_cleaning.hpp"

namespace kinemend {

/// Share of the measurements that `auto` takes for spikes, or that are far from `result` (F x D)
/// where most of their channel are not.
double suspect_share(const PriorWork& work, const PoseMatrix& result);

/// Before the filter: what each part needs of it. All of it where `hold` is nothing, and where one
/// sample in fifty is a spike to `auto` or far from what that makes of the take; nothing where a
/// filter that takes noise for white meets noise with a colour, or frames that are samples of a
/// lower rate, as `auto` sees it (the filter may fill gaps); otherwise `work.needs` stays.
void settle_needs(PriorWork& work, PriorHold hold);

/// From a filter that finds this share of the measurements to be outliers: where that is more than
/// one in fifty, what `auto` makes of the take is no measure of the filter's result, as it may have
/// taken the outliers for noise. Parts that need nothing of the filter stay `auto`'s.
void release_if_crowded(PriorWork& work, double outliers);

/// Puts what `auto` makes of the take in the place of what the filter made of it, by 1 - need for
/// each part (`work.needs`): a part in which `auto` finds nothing stays as it is. What the filter
/// put into gaps moves with the samples beside them. A sample that is farther from
/// `auto`'s than the noise's deviation (of all three axes) is put at that distance.
void hold_to_needs(PriorWork& work);

/// A mark for each part of the model's layout (N): 1 where the filter has a say, by need or by gaps
/// that it fills where `fill` is set. Parts that the take lacks, or that are left out, have 0.
std::vector<std::uint8_t> wanted_parts(const PriorWork& work, bool fill);

/// Whether the filter has no say in a part: no need, and nothing that it may fill.
bool is_left_alone(const PriorWork& work, std::size_t part, bool fill);

}  // namespace kinemend
