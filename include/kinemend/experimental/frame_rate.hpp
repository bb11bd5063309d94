// The frame rates that takes may have.
#pragma once

#include <algorithm>

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

}  // namespace kinemend
