#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/marker_clip.hpp"

// The step of the pipeline that fills gaps.
namespace kinemend {

/// Fills the gaps of the selected joints or markers in the frames of weight above 0, in place. The
/// methods see the take without its spikes, as `auto` finds them; nothing but gaps changes. The
/// report lists the gaps of what is selected.
FillReport fill_step(Clip& clip, const std::vector<std::uint8_t>& selected,
                     const std::vector<double>& weights, const FillSettings& settings);
FillReport fill_step(MarkerClip& clip, const std::vector<std::uint8_t>& selected,
                     const std::vector<double>& weights, const FillSettings& settings);

}  // namespace kinemend
