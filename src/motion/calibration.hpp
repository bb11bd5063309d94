// The motion of a clip without its calibration frames (`leading_calibration_frames`).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "kinemend/take.hpp"

namespace kinemend {

/// Calls `work` with the clip without its first `frames` frames, and puts these back unchanged,
/// also if `work` throws. `work` may change any sample and add masks, but not the number of frames.
/// In a mask that it adds, the frames put back are observed.
void on_motion(Take& clip, std::size_t frames, const std::function<void(Take&)>& work);

/// Returns the clip from frame `first` on, for reading: the clip itself if `first` is 0, which
/// avoids a copy; else a slice stored in `sliced`.
const Take& frames_from(const Take& clip, std::size_t first, std::optional<Take>& sliced);

}  // namespace kinemend
