// Notes which parts of a take a learned model did not decide, and why.
#pragma once

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

}  // namespace kinemend
