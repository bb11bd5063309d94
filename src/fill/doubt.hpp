// Finds samples beside a gap that may be spikes.
#pragma once

#include <cstddef>

#include "fill/track.hpp"

namespace kinemend::fill {

/// How many samples on either side of a gap may be spikes: 0 or 2.
struct Doubt {
  std::size_t before = 0, behind = 0;

  bool any() const { return before + behind > 0; }
  FrameSpan widened(FrameSpan gap) const { return {gap.first - before, gap.last + behind}; }
  friend bool operator==(const Doubt&, const Doubt&) = default;
};

/// A sample beside a gap has no neighbour on one side that would tell a spike from motion. It is
/// doubted where the second difference it ends is greater than three times any other within half a
/// second, and than `least` (file units or degrees). Of a filling of the gap with the doubted
/// samples in it they have to be far as well.
Doubt doubt_beside(const Track& track, FrameSpan gap, double frame_rate_hz, double least);

/// Frames on either side of a gap that this looks at.
std::size_t doubt_reach(double frame_rate_hz);

/// Of an offset between two samples of the track: file units or degrees.
inline double size_of(const Track& track, Vec3 offset) {
  return track.is_position ? norm(offset) : norm(offset) * degrees_per_radian;
}

}  // namespace kinemend::fill
