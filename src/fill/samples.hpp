// The samples of a marker take as its methods see them, and the samples observed beside a gap.
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

/// The samples of a marker take: F x M, frame-major. A filled sample is evidence for other markers
/// but not for its own marker.
struct Samples {
  std::size_t frames = 0;
  std::size_t markers = 0;
  double frame_rate_hz = 0;
  std::span<const Vec3> positions;
  std::span<const std::uint8_t> measured;  ///< 1 where the take has a position
  std::span<const std::uint8_t> seen;      ///< 1 if measured, or filled as evidence
  std::vector<std::size_t> bodies;         ///< the markers that are evidence
  std::int64_t first_frame = 1;            ///< the number of frame 0, for messages
  std::string unit{};                      ///< of lengths, for messages
  double radius = 0;                       ///< of the body, the scale of errors (`body_radius`)

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
  /// Returns the number of frames in `seconds`, rounded, at least `least`.
  std::size_t frames_in(double seconds, std::size_t least) const;
};

/// A requested span of missing samples of one marker. Samples of the marker inside the span are
/// never used, so a method can be tried on an observed span.
struct MarkerGap {
  std::size_t marker = 0;
  FrameSpan span;
  TakeEnds ends = {};  ///< whether the marker is never seen beyond the span's start or end

  bool covers(std::size_t frame) const { return frame >= span.first && frame <= span.last; }
};

/// Returns the root mean square distance of the take's markers to their centre, in file units, over
/// at most 64 frames; 0 if no two are ever seen together.
double body_radius(const Samples& samples);

/// Returns the marker's own samples around a gap, as many as a curve needs; samples in the gap are
/// missing.
Track track_around(const Samples& samples, const MarkerGap& gap);

/// Returns the frames of the gap's evidence (`evidence_around`) that show its marker outside the
/// gap and all of these other markers.
std::vector<std::size_t> frames_showing(const Samples& samples, const MarkerGap& gap,
                                        std::span<const std::size_t> others);

/// Returns up to 12 observed frames of the gap's marker on either side, within 0.5 s (at least 12
/// frames) of the gap, ascending, that also show all of these other markers. They determine how a
/// guess is moved.
std::vector<std::size_t> frames_beside(const Samples& samples, const MarkerGap& gap,
                                       std::span<const std::size_t> others);

/// Returns the markers other than the gap's own that are seen in every frame of the span.
std::vector<std::size_t> helpers_of(const Samples& samples, const MarkerGap& gap);

}  // namespace kinemend::fill
