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
  std::size_t resampled = 0;  ///< curves without exactly one key per frame
};

/// Whether a curve has one key per frame.
bool is_baked(const FbxCurve& curve, const FbxFrames& frames);

/// Finds the frames of a take. `curves`: the joints' curves, by index in `motion`. Frames are the
/// keys if these lie on one grid, else the grid of the file's time mode from the first key to the
/// last. `most_frames`: a larger number is an error. Errors: `unreadable_input`.
FbxFrames find_fbx_frames(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                          const std::vector<std::size_t>& curves, std::size_t most_frames);

}  // namespace kinemend
