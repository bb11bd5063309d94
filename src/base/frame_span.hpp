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

/// Returns the runs of frames below `frames` for which `holds(frame)` is true, in order. Up to
/// `most_between` other frames do not end a run.
template <class Holds>
std::vector<FrameSpan> runs_where(std::size_t frames, const Holds& holds,
                                  std::size_t most_between = 0) {
  std::vector<FrameSpan> runs;
  for (std::size_t t = 0; t < frames; ++t) {
    if (!holds(t)) continue;
    if (!runs.empty() && t <= runs.back().last + 1 + most_between) {
      runs.back().last = t;
    } else {
      runs.push_back({t, t});
    }
  }
  return runs;
}

/// Puts samples that are not known on the straight line between their known neighbours, and holds
/// the ends; without a known sample nothing changes. `at(frame)` returns a reference to a sample.
template <class Known, class At>
void bridge(std::size_t frames, const Known& is_known, const At& at) {
  std::size_t before = frames;  // the last known frame; `frames`: none yet
  for (std::size_t f = 0; f < frames; ++f) {
    if (!is_known(f)) continue;
    for (std::size_t g = before == frames ? 0 : before + 1; g < f; ++g) {
      if (before == frames) {
        at(g) = at(f);
        continue;
      }
      const double u = static_cast<double>(g - before) / static_cast<double>(f - before);
      at(g) = at(before) + u * (at(f) - at(before));
    }
    before = f;
  }
  for (std::size_t g = before == frames ? frames : before + 1; g < frames; ++g) at(g) = at(before);
}

/// Returns up to `most` of so many frames, evenly spread, ascending.
inline std::vector<std::size_t> evenly_spread(std::size_t frames, std::size_t most) {
  std::vector<std::size_t> some(std::min(frames, most));
  for (std::size_t i = 0; i < some.size(); ++i) some[i] = i * frames / some.size();
  return some;
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
