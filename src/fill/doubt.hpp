// Finds samples beside a gap that may be spikes.
#pragma once

#include <cstddef>

#include "fill/track.hpp"

namespace kinemend::fill {

/// The number of samples on either side of a gap that may be spikes: 0 or 2.
struct Doubt {
  std::size_t before = 0, behind = 0;

  bool any() const { return before + behind > 0; }
  FrameSpan widened(FrameSpan gap) const { return {gap.first - before, gap.last + behind}; }
  friend bool operator==(const Doubt&, const Doubt&) = default;
};

/// A sample beside a gap has no neighbour on one side that would distinguish a spike from motion.
/// It is doubted if its second difference exceeds three times any other within half a second, and
/// exceeds `least` (file units or degrees). A doubted sample is a spike only if it is also far from
/// a filling that does not use it.
Doubt doubt_beside(const Track& track, FrameSpan gap, double frame_rate_hz, double least);

/// Returns the number of frames on either side of a gap that `doubt_beside` reads.
std::size_t doubt_reach(double frame_rate_hz);

/// Returns the size of an offset between two samples of the track, in file units or degrees.
inline double size_of(const Track& track, Vec3 offset) {
  return track.is_position ? norm(offset) : norm(offset) * degrees_per_radian;
}

}  // namespace kinemend::fill
