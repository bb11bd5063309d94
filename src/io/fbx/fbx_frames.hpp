// Finds the times of the frames of a take from the keys of its curves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/fbx/fbx_scene.hpp"

namespace kinemend {

struct FbxFrames {
  std::vector<std::int64_t> times;  ///< ticks, at least one, ascending
  double rate_hz = 30;
  double step_ticks = 0;
  std::size_t resampled = 0;  ///< curves that have other keys than one a frame
};

/// Whether a curve has one key a frame.
bool is_baked(const FbxCurve& curve, const FbxFrames& frames);

/// `curves`: those of the joints, by index in `motion`. Frames are the keys where these lie on one
/// grid, else the grid of the file's time mode from the first key to the last. `most_frames`: more
/// are an error. Errors: `unreadable_input`.
FbxFrames find_fbx_frames(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                          const std::vector<std::size_t>& curves, std::size_t most_frames);

}  // namespace kinemend
