#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fill/curves.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend::fill {

/// The samples of a marker take: F x M, frame-major. A sample that was filled before tells where
/// other markers are, but nothing of its own marker.
struct Samples {
  std::size_t frames = 0;
  std::size_t markers = 0;
  double frame_rate_hz = 0;
  std::span<const Vec3> positions;
  std::span<const std::uint8_t> measured;  ///< 1 where the take has a position
  std::span<const std::uint8_t> seen;      ///< 1 there, and where one was filled on good grounds
  std::vector<std::size_t> bodies;         ///< the markers that are positions at all
  std::int64_t first_frame = 1;            ///< the number of frame 0, for messages
  double radius = 0;  ///< of the body, by which errors are judged (`body_radius`)

  bool measures(std::size_t frame, std::size_t marker) const {
    return measured[frame * markers + marker] != 0;
  }
  bool sees(std::size_t frame, std::size_t marker) const {
    return seen[frame * markers + marker] != 0;
  }
  Vec3 at(std::size_t frame, std::size_t marker) const {
    return positions[frame * markers + marker];
  }
  /// Frames in `seconds`, rounded, at least `least`.
  std::size_t frames_in(double seconds, std::size_t least) const;
};

/// The missing samples of one marker that are asked for. Samples of the marker inside the span are
/// never used, so that an observed span serves to try a method.
struct MarkerGap {
  std::size_t marker = 0;
  FrameSpan span;
  bool starts_take = false;  ///< nothing of the marker is seen before the span
  bool ends_take = false;    ///< nothing of it is seen behind the span

  bool covers(std::size_t frame) const { return frame >= span.first && frame <= span.last; }
};

/// Root mean square distance of the take's markers to their centre, file units, over at most 64
/// frames; 0 where no two are seen together.
double body_radius(const Samples& samples);

/// The frames that a gap is filled from: a minute on either side, or ten times its length where
/// that is more, so that the cost of a gap does not grow with the take.
FrameSpan evidence_around(const Samples& samples, const MarkerGap& gap);

/// Observed frames of the gap's marker near the gap, up to `most` on either side and none farther
/// than `reach` frames, ascending.
std::vector<std::size_t> frames_beside(const Samples& samples, const MarkerGap& gap,
                                       std::size_t most, std::size_t reach);

/// The markers that are seen in every frame of the span, without the gap's own.
std::vector<std::size_t> helpers_of(const Samples& samples, const MarkerGap& gap);

/// Up to `most` of the frames, evenly chosen.
std::vector<std::size_t> evenly(const std::vector<std::size_t>& frames, std::size_t most);

}  // namespace kinemend::fill
