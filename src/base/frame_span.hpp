// Spans of frames, runs of frames with a property, fades across a span, and seconds as a number of
// frames.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace kinemend {

/// Frames first to last, inclusive.
struct FrameSpan {
  std::size_t first = 0;
  std::size_t last = 0;

  std::size_t length() const noexcept { return last - first + 1; }
};

/// Returns the runs of frames below `frames` for which `holds(frame)` is true, in order.
template <class Holds>
std::vector<FrameSpan> runs_where(std::size_t frames, const Holds& holds) {
  std::vector<FrameSpan> runs;
  for (std::size_t t = 0; t < frames; ++t) {
    if (!holds(t)) continue;
    if (!runs.empty() && runs.back().last + 1 == t) {
      runs.back().last = t;
    } else {
      runs.push_back({t, t});
    }
  }
  return runs;
}

/// Frames in `seconds`, rounded, at least `least`.
inline std::size_t frames_in(double seconds, double frame_rate_hz, std::size_t least) {
  // The largest number of frames; chosen by hand.
  constexpr double most = 1e9;
  const double frames = std::round(seconds * frame_rate_hz);
  return std::max(least, static_cast<std::size_t>(std::min(frames, most)));
}

/// The weight of a fade at the share `x` (0..1) of its way: rises from 0 to 1, level at both ends.
constexpr double smooth_step(double x) { return x * x * (3 - 2 * x); }

}  // namespace kinemend
