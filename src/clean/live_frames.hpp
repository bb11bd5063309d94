#pragma once

#include <cstddef>

#include "kinemend/cleaner.hpp"
#include "kinemend/clip.hpp"

namespace kinemend {

/// Frame `frame` of a clip as a live frame.
LiveFrame frame_of(const Clip& clip, std::size_t frame);

/// Runs the frame filter of a causal cleaner over the clip from its first frame to its last and
/// writes the selected parts back. Unobserved samples that are selected are marked as filled.
CleanTrace clean_causally(const Cleaner& cleaner, Clip& clip, const Selection& selection);

}  // namespace kinemend
