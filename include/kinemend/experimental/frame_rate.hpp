#pragma once

#include <algorithm>

namespace kinemend {

/// The rates that takes may have, hertz. Readers take any other for unknown, with a warning; an
/// option outside is a usage error.
inline constexpr double least_frame_rate_hz = 0.1;
inline constexpr double most_frame_rate_hz = 100000;

/// Whether a take may have this rate; what the reciprocal of a frame time rounds off is forgiven.
constexpr bool is_usable_frame_rate(double frame_rate_hz) {
  constexpr double rounding = 1e-6;
  return frame_rate_hz >= least_frame_rate_hz * (1 - rounding) &&
         frame_rate_hz <= most_frame_rate_hz * (1 + rounding);
}

/// Errors: `ErrorKind::usage` for a rate that no take may have.
void check_frame_rate(double frame_rate_hz);

/// The rate by which windows of time are counted in frames: no window holds more of them than it
/// would at 1,000 Hz, so that the cost of a frame is bounded whatever the rate.
constexpr double window_rate_hz(double frame_rate_hz) {
  constexpr double most = 1000;
  return std::min(frame_rate_hz, most);
}

}  // namespace kinemend
