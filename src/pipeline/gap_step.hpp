// The step of the pipeline that fills gaps after the cleaner; filled samples are no measurements.
#pragma once

#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/gap_plan.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Fills the gaps of the selected joints or markers in the frames of weight above 0. `measured` is
/// the take before the cleaner, `cleaned` behind it, with what the cleaner says of it in `trace`;
/// the gaps are filled in `cleaned`, from its samples, so that they meet these. Where the cleaner
/// has left spikes, as `auto` finds them, they are filled from a take that was cleaned without
/// them. A gap that is refused stays as the cleaner has left it. The report lists the gaps of what
/// is selected.
FillReport fill_step(const Take& measured, const Cleaner& cleaner, const Selection& selection,
                     const std::vector<double>& weights, const FillSettings& settings,
                     const InPlaceTrace& trace, Take& cleaned, const FillCheck& check = {});

}  // namespace kinemend
