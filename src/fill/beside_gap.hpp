#pragma once

#include <algorithm>
#include <cstddef>

#include "fill/curves.hpp"

namespace kinemend::fill {

/// How many samples on either side of a gap may be spikes: 0 or `most_doubted`.
struct Doubt {
  std::size_t before = 0, behind = 0;

  bool any() const { return before + behind > 0; }
  FrameSpan widened(FrameSpan gap) const { return {gap.first - before, gap.last + behind}; }
};
inline constexpr std::size_t most_doubted = 2;

/// A sample beside a gap has no neighbour on one side that would tell a spike from motion. It is
/// doubted where the second difference it ends is greater than `clearly` times any other within
/// half a second, and than `least`. Of a filling of the gap with the doubted samples in it they
/// have to be far as well. `leap(f)`: size of the second difference over the frames f - 1 to f + 1;
/// negative where one of them is not measured.
template <class Leap>
Doubt doubt_beside(FrameSpan gap, std::size_t frames, double frame_rate_hz, double least,
                   const Leap& leap) {
  constexpr double clearly = 3;
  const auto half_second = static_cast<std::size_t>(0.5 * frame_rate_hz) + 8;
  const std::size_t first = gap.first - std::min(gap.first, half_second);
  const std::size_t end = std::min(frames, gap.last + 1 + half_second);
  const auto is_near = [](std::size_t a, std::size_t b) {
    return (a > b ? a - b : b - a) <= most_doubted;
  };
  // The middle of the second differences that the samples next to the gap end.
  const std::size_t before = gap.first >= 2 ? gap.first - 2 : frames;
  const std::size_t behind = gap.last + 2 < frames ? gap.last + 2 : frames;
  double usual = least / clearly;
  std::size_t seen = 0;
  for (std::size_t f = std::max<std::size_t>(first, 1); f + 1 < end; ++f) {
    if (is_near(f, before) || is_near(f, behind)) continue;
    const double size = leap(f);
    seen += size >= 0;
    usual = std::max(usual, size);
  }
  constexpr std::size_t least_seen = 8;
  Doubt doubt;
  if (seen < least_seen) return doubt;
  if (gap.first >= 3 + most_doubted && leap(before) > clearly * usual) doubt.before = most_doubted;
  if (gap.last + 3 + most_doubted < frames && leap(behind) > clearly * usual)
    doubt.behind = most_doubted;
  return doubt;
}

}  // namespace kinemend::fill
