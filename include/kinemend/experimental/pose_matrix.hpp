// A matrix of channels over frames, on which filters work.
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace kinemend {

/// F frames x D channels, frame-major: the channels of one frame are contiguous, and a window of
/// frames is one block of memory. The code that encodes a matrix defines the meaning of its
/// channels (see `body.hpp`).
struct PoseMatrix {
  std::size_t frames = 0;
  std::size_t channels = 0;
  std::vector<double> values;  ///< frames * channels

  PoseMatrix() = default;
  PoseMatrix(std::size_t frame_count, std::size_t channel_count, double value = 0.0)
      : frames(frame_count), channels(channel_count), values(frame_count * channel_count, value) {}

  double& operator()(std::size_t frame, std::size_t channel) {
    assert(frame < frames && channel < channels);
    return values[frame * channels + channel];
  }
  double operator()(std::size_t frame, std::size_t channel) const {
    assert(frame < frames && channel < channels);
    return values[frame * channels + channel];
  }
  std::span<double> row(std::size_t frame) { return {values.data() + frame * channels, channels}; }
  std::span<const double> row(std::size_t frame) const {
    return {values.data() + frame * channels, channels};
  }
};

}  // namespace kinemend
