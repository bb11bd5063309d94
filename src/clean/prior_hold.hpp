#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "clean/prior_cleaning.hpp"

// Hands off what is clean: a learned model changes a part no further than its noise asks for.
namespace kinemend {

/// Puts what `auto` makes of the take in the place of what the filter made of it, by 1 - need for
/// each part (`work.needs`): a part in which `auto` finds nothing stays as it is. What the filter
/// put into gaps moves with the samples beside them. A sample that is farther from
/// `auto`'s than the noise's deviation (of all three axes) is put at that distance. Where one
/// sample in fifty is a spike to `auto`, every part needs the filter, all of it.
void hold_to_needs(PriorWork& work);

/// Of a filter that is told what to do: every part has all of it.
void take_whole(PriorWork& work);

/// Of a filter that takes noise for white: no part needs it where noise has a colour, or frames are
/// samples of a lower rate, which `auto` sees. The filter may fill gaps.
void leave_coloured_noise_to_auto(PriorWork& work);

/// A mark for each part of the model's layout (N): 1 where the filter has a say, by need, by gaps
/// that it fills where `fill` is set, or because spikes are dense. Parts that the take lacks, or
/// that are left out, have 0. What is 0 everywhere needs no filter at all.
std::vector<std::uint8_t> wanted_parts(const PriorWork& work, bool fill);

/// Whether the filter has no say in a part: no need, and nothing that it may fill.
bool is_left_alone(const PriorWork& work, std::size_t part, bool fill);

}  // namespace kinemend
