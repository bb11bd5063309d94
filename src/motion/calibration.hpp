#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "kinemend/clip.hpp"

// The motion of a clip without what stands before it (`leading_calibration_frames`).
namespace kinemend {

/// Calls `work` with the clip without its first `frames` frames, and puts these back as they were,
/// also where `work` throws. It may change any sample and bring masks along, but not the number of
/// frames. Of a mask that only it brings, the frames put back are observed.
void on_motion(Clip& clip, std::size_t frames, const std::function<void(Clip&)>& work);

/// The clip from frame `first` on, to be read: itself where that is 0, for a long one is not
/// copied; else put into `part`.
const Clip& frames_from(const Clip& clip, std::size_t first, std::optional<Clip>& part);

}  // namespace kinemend
