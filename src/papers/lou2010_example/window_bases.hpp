// Filter bases as functions of time, sampled at a clip's frames.
#pragma once

#include <cstddef>
#include <vector>

#include "papers/lou2010_example/mssa.hpp"

namespace kinemend {

/// Filter bases as functions of time, sampled at a clip's frames.
struct WindowBases {
  std::size_t frames = 0;    ///< of a window, M' of the clip
  std::size_t hop = 1;       ///< frames from one sliding window to the next: one frame of the model
  std::size_t channels = 0;  ///< L
  std::size_t count = 0;     ///< K
  /// M' L x K, row-major. With an `interpolation` the model's own values, M L x K.
  std::vector<double> values;
  /// Whether the columns of `values` are orthonormal (to the precision of the model's file): whole
  /// windows at the model's own rate.
  bool orthonormal = false;
  /// M' x M, row-major: frames of the clip as weighted sums of frames of the model. Empty: `values`
  /// are sampled at the clip's frames already.
  std::vector<double> interpolation = {};

  bool is_interpolated() const noexcept { return !interpolation.empty(); }
  /// M, of an interpolated window.
  std::size_t model_frames() const noexcept { return interpolation.size() / frames; }
};

/// Bases that would have more values at the rate of the clip (32 MB) keep the model's frames, so
/// that memory does not grow with the rate. Not swept.
inline constexpr std::size_t most_sampled_values = std::size_t{1} << 22;

/// The bases at the rate of a clip of `clip_frames` frames (1 or more), by a cubic spline through
/// their M frames. A clip shorter than a window gets the middle of the window. `count`: number of
/// leading bases; 0: all. Bases that would have more than `most_values` are interpolated.
WindowBases bases_at_rate(const FilterBases& bases, double model_rate_hz, double clip_rate_hz,
                          std::size_t clip_frames, std::size_t count = 0,
                          std::size_t most_values = most_sampled_values);

}  // namespace kinemend
