// The samples of a marker take as its methods see them, and what is seen beside a gap.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fill/track.hpp"
#include "kinemend/take.hpp"

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
  std::vector<std::size_t> bodies;         ///< the markers that are evidence
  std::int64_t first_frame = 1;            ///< the number of frame 0, for messages
  std::string unit{};                      ///< of lengths, for messages
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
  bool sees(std::size_t frame, std::span<const std::size_t> all) const {
    return std::all_of(all.begin(), all.end(), [&](std::size_t m) { return sees(frame, m); });
  }
  /// Frames in `seconds`, rounded, at least `least`.
  std::size_t frames_in(double seconds, std::size_t least) const;
};

/// The missing samples of one marker that are asked for. Samples of the marker inside the span are
/// never used, so that an observed span serves to try a method.
struct MarkerGap {
  std::size_t marker = 0;
  FrameSpan span;
  TakeEnds ends = {};  ///< nothing of the marker is seen beyond the span

  bool covers(std::size_t frame) const { return frame >= span.first && frame <= span.last; }
};

/// Root mean square distance of the take's markers to their centre, file units, over at most 64
/// frames; 0 where no two are seen together.
double body_radius(const Samples& samples);

/// The marker's own samples around a gap, which are missing in it: as many as a curve needs, other
/// gaps between them aside.
Track track_around(const Samples& samples, const MarkerGap& gap);

/// The frames of the gap's evidence (`evidence_around`) that show its marker outside the gap and
/// all of these others.
std::vector<std::size_t> frames_showing(const Samples& samples, const MarkerGap& gap,
                                        std::span<const std::size_t> others);

/// Up to 12 observed frames of the gap's marker on either side, which show all of these others too,
/// within 0.5 s (at least 12 frames) of the gap, ascending: they tell how a guess has to be moved.
std::vector<std::size_t> frames_beside(const Samples& samples, const MarkerGap& gap,
                                       std::span<const std::size_t> others);

/// The markers that are seen in every frame of the span, without the gap's own.
std::vector<std::size_t> helpers_of(const Samples& samples, const MarkerGap& gap);

}  // namespace kinemend::fill
