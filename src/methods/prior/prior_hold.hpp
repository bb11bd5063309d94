// Holds a learned model back: it changes a part no further than its noise justifies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "methods/prior/prior_cleaning.hpp"

namespace kinemend {

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

}  // namespace kinemend
