// The samples of a marker take as its methods see them, and groups of markers that move nearly as a
// rigid body.
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

/// The place of a group of markers in one frame.
struct Placement {
  Quat rotation;  ///< from the group's mean shape to the world
  Vec3 centre;

  Vec3 to_local(Vec3 world) const { return rotate(conjugate(rotation), world - centre); }
  Vec3 to_world(Vec3 local) const { return centre + rotate(rotation, local); }
};

/// Markers that move nearly as a rigid body, and the frame of reference that moves with them: the
/// rotation and shift that fit their mean shape to them by weighted least squares (Kabsch 1976; by
/// quaternions, Horn 1987).
class MarkerGroup {
 public:
  MarkerGroup(std::vector<std::size_t> markers, std::vector<double> weights);

  /// Finds the mean shape over these frames. Every marker of the group must be seen in them.
  void fit_shape(const Samples& samples, std::span<const std::size_t> frames);

  std::span<const std::size_t> markers() const { return markers_; }
  std::span<const Vec3> shape() const { return shape_; }
  /// False for fewer than three markers, or if they lie nearly on one line: the group's rotation is
  /// then unknown, and placements only shift.
  bool turns() const { return turns_; }
  Placement placement(const Samples& samples, std::size_t frame) const;

 private:
  Vec3 centre_of(const Samples& samples, std::size_t frame) const;
  bool spans_a_plane() const;

  std::vector<std::size_t> markers_;
  std::vector<double> weights_;  // sum 1
  std::vector<Vec3> shape_;      // about its weighted centre
  bool turns_ = false;
};

/// A marker that keeps its distance to another one.
struct Companion {
  std::size_t marker = 0;
  double spread = 0;  ///< standard deviation of the distance, file units
};

/// Returns the helpers by the spread of their distance to the gap's marker, least first, without
/// those never seen together with it. Uses at most 192 frames.
std::vector<Companion> companions_of(const Samples& samples, const MarkerGap& gap,
                                     std::span<const std::size_t> helpers);

}  // namespace kinemend::fill
