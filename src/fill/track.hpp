// One track of rotations or positions as vectors, with its gaps, and the result of filling a span
// of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/frame_span.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"
#include "motion/rotation.hpp"

namespace kinemend::fill {

/// Builds a chart whose reference is the rotation itself where it is observed and follows the
/// geodesic through a gap. A curve through the observed vectors then has their angular velocity at
/// its ends, the straight line is slerp, and no turn is cut at 180 degrees.
/// Through a gap the reference takes the shortest turn, or one longer by a whole turn about the
/// same axis if the velocities at both ends agree with it. Before the first and after the last
/// observed frame it is constant.
RotationChart make_rotation_chart(std::span<const Quat> rotations,
                                  std::span<const std::uint8_t> observed, double frame_rate_hz);

/// One frame of a track.
struct Sample {
  Vec3 value;     ///< in the track's own vectors
  Quat rotation;  ///< only if the track is of rotations
};

/// Samples of one joint's rotation, or of a position of a joint or marker, as vectors. Only
/// observed samples are evidence: a filled one stays marked as missing, so that the order in which
/// gaps are filled does not affect the result.
struct Track {
  std::vector<Vec3> values;            ///< F: positions, or the chart's vectors
  std::vector<std::uint8_t> observed;  ///< F
  bool is_position = true;
  RotationChart chart = {};     ///< for rotations
  std::size_t joint = 0;        ///< for a track of a joint
  std::size_t first_frame = 0;  ///< the frame of the take at which the track begins

  std::size_t frames() const noexcept { return observed.size(); }
  Quat rotation(std::size_t frame) const { return chart.rotation_of(frame, values[frame]); }
  Sample sample_of(std::size_t frame, Vec3 value) const {
    return {value, is_position ? Quat{} : chart.rotation_of(frame, value)};
  }
  Sample sample(std::size_t frame) const { return sample_of(frame, values[frame]); }
  /// Returns the offset from a sample of this or another track to the sample in `frame`: a
  /// difference of positions, or Log(other^-1 own).
  Vec3 offset_from(const Sample& other, std::size_t frame) const {
    if (is_position) return values[frame] - other.value;
    return log(conjugate(other.rotation) * rotation(frame));
  }
};

/// Converts a span of the take's frames to frames of the track.
inline FrameSpan within(const Track& track, FrameSpan span) {
  return {span.first - track.first_frame, span.last - track.first_frame};
}
inline std::vector<Vec3> values_in(const Track& track, FrameSpan span) {
  const auto first = track.values.begin() + static_cast<std::ptrdiff_t>(span.first);
  return {first, first + static_cast<std::ptrdiff_t>(span.length())};
}

Track rotation_track(const Take& clip, std::size_t joint);
/// `position`: 0 for joint 0, k + 1 for translated joint k.
Track position_track(const Take& clip, std::size_t position);

/// Whether a span is filled as if the take started or ended with it.
struct TakeEnds {
  bool at_start = false, at_end = false;

  bool any() const { return at_start || at_end; }
};

/// Returns the span and up to `reach` frames on either side, in a take of `frames` frames.
FrameSpan surroundings(FrameSpan span, TakeEnds ends, std::size_t reach, std::size_t frames);

Track part_of(const Track& track, FrameSpan kept);

/// Returns the track up to `reach` frames around an observed span, as if that were a gap: the chart
/// knows none of its samples. With `ends` the take also ends there.
Track hide_span(const Track& track, FrameSpan span, TakeEnds ends, std::size_t reach,
                double frame_rate_hz);

/// Returns the whole track as if the span were missing too.
Track without_span(const Track& track, FrameSpan span, double frame_rate_hz);

/// Returns up to `most` of the frames, evenly chosen.
std::vector<std::size_t> evenly(const std::vector<std::size_t>& frames, std::size_t most);
/// Returns the span's frames, or `most` of them.
std::vector<std::size_t> frames_of(FrameSpan span, std::size_t most = SIZE_MAX);

/// The result of filling a span of a track by one method.
struct Filling {
  std::vector<Vec3> values = {};  ///< of the span's frames, in the track's vectors; empty: refused
  std::string method = {};        ///< the method that made them, or was tried last
  std::string reason = {};        ///< the reason for the refusal
  /// Root mean square distance to the ground truth, file units or degrees; 0: unknown.
  double expected_error = 0;
  /// Refused because other tracks are missing now; a later round may succeed.
  bool may_wait = false;
  /// Made from other tracks, so that it is evidence for them in turn; a curve is not.
  bool is_evidence = true;
  /// Markers whose movement it was made from; empty for a curve, and for joints.
  std::vector<std::size_t> markers_used = {};
  /// The reason why the requested model left the gap to `auto`; empty: no model was requested, or
  /// it filled the gap.
  std::string left_to_auto = {};

  bool made() const { return !values.empty(); }
  static Filling refused(std::string_view method, std::string reason, bool may_wait = false) {
    return {{}, std::string(method), std::move(reason), 0, may_wait};
  }
};

}  // namespace kinemend::fill
