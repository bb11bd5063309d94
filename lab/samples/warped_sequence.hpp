// Plays a sequence faster or slower.
#pragma once

#include <cstddef>

#include "kinemend/extend/frames.hpp"

namespace kinemend {

/// The first `frames` frames of a sequence that runs at `speed` times its pace: Catmull-Rom's cubic
/// through the frames, read at every `speed`-th; it holds its end values beyond its ends.
PoseMatrix warped(const PoseMatrix& poses, double speed, std::size_t frames);

}  // namespace kinemend
