// The step of the pipeline that stops feet from sliding.
#pragma once

#include <cstddef>

#include "kinemend/cleaner.hpp"
#include "kinemend/feet.hpp"

namespace kinemend {

/// Holds feet in place as far as the selection lets legs and root move. `motion` begins with frame
/// `first` of the take, by whose frames settings and report go. What changed is stated in `trace`,
/// over what the cleaner did; filled and despiked samples stay such.
FeetReport feet_step(Take& motion, const Selection& selection, const FeetSettings& settings,
                     std::size_t first, InPlaceTrace& trace);

}  // namespace kinemend
