// The frame rates that takes may have, and a matrix of channels over frames, on which filters work.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace kinemend {

/// The rates that takes may have, hertz. Readers treat any other rate as unknown, with a warning;
/// an option outside this range is a usage error.
inline constexpr double least_frame_rate_hz = 0.1;
inline constexpr double most_frame_rate_hz = 100000;

/// Whether a take may have this rate. Tolerates the rounding of a frame time.
constexpr bool is_usable_frame_rate(double frame_rate_hz) {
  constexpr double rounding = 1e-6;
  return frame_rate_hz >= least_frame_rate_hz * (1 - rounding) &&
         frame_rate_hz <= most_frame_rate_hz * (1 + rounding);
}

/// Throws `ErrorKind::usage` for a rate that no take may have.
void check_frame_rate(double frame_rate_hz);

/// The rate for converting windows of time to frames. At most 1,000 Hz, so that the cost of a frame
/// is bounded at any rate.
constexpr double window_rate_hz(double frame_rate_hz) {
  constexpr double most = 1000;
  return std::min(frame_rate_hz, most);
}

/// F frames x D channels, frame-major: the channels of one frame are contiguous, and a window of
/// frames is one block of memory. The code that encodes a matrix defines the meaning of its
/// channels (see `representation.hpp`).
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
