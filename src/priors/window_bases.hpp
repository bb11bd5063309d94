#pragma once

#include <cstddef>
#include <vector>

#include "priors/mssa.hpp"

namespace kinemend {

/// Filter bases as functions of time, sampled at a clip's frames.
struct WindowBases {
  std::size_t frames = 0;    ///< of a window, M' of the clip
  std::size_t hop = 1;       ///< frames from one sliding window to the next: one frame of the model
  std::size_t channels = 0;  ///< L
  std::size_t count = 0;     ///< K
  std::vector<double> values;  ///< M' L x K, row-major
  /// The columns of `values` are, as far as the model's file stores them: whole windows at the
  /// model's own rate.
  bool orthonormal = false;
};

/// The bases at the rate of a clip of `clip_frames` frames (1 or more), by a cubic spline through
/// their M frames. A clip shorter than a window gets the middle of the window. `count`: number of
/// leading bases; 0: all.
WindowBases bases_at_rate(const FilterBases& bases, double model_rate_hz, double clip_rate_hz,
                          std::size_t clip_frames, std::size_t count = 0);

}  // namespace kinemend
