// Notes which parts of a take a learned model did not decide, and why.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "learned/core/prior_cleaning.hpp"

namespace kinemend {

/// Notes that so much of each part (`shares`, D / 3, 0..1) is now what `auto` makes of it; what was
/// noted before becomes so much less.
void add_fall_back(PriorWork& work, std::string reason, std::vector<double> shares);

/// Whether most of a part is what `auto` makes of it: then what was done to it is what `auto` did.
bool is_fallen_back(const PriorWork& work, std::size_t part);

/// What was noted, by joint or marker, and the tracks that the model does not know. `selected`: one
/// a joint or marker; `place`: whether the part behind the layout's is the root position.
std::vector<FallBack> fall_backs_of(const PriorWork& work,
                                    const std::vector<std::uint8_t>& selected, bool place);

}  // namespace kinemend
