#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fill/curves.hpp"
#include "kinemend/clip.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend::fill {

/// Rotations as vectors in radians with no singularity however far the joint turns: the increments
/// Log(b[t]^-1 b[t+1]) of a reference b add up to a path in R^3, and a rotation is that path's
/// point plus its own offset Log(b[t]^-1 q[t]). The reference is the rotation itself where it is
/// observed and runs along the geodesic through a gap, so that a curve through the observed vectors
/// has their angular velocity at its ends, the straight line is slerp, and no turn is cut at 180
/// degrees.
struct RotationChart {
  std::vector<Quat> reference;  ///< F
  std::vector<Vec3> path;       ///< F

  Vec3 vector_of(std::size_t frame, Quat rotation) const {
    return path[frame] + log(conjugate(reference[frame]) * rotation);
  }
  Quat rotation_of(std::size_t frame, Vec3 vector) const {
    return normalized(reference[frame] * exp(vector - path[frame]));
  }
};

/// Through a gap the reference takes the shortest way, or one with a whole turn more about the same
/// axis where the velocities at both ends tell of it; before the first and behind the last observed
/// frame it rests.
RotationChart make_rotation_chart(std::span<const Quat> rotations,
                                  std::span<const std::uint8_t> observed, double frame_rate_hz);

/// One joint's rotation or a position, over time, as a track to fill.
struct JointTrack {
  std::size_t joint = 0;
  bool is_position = false;
  std::size_t first_frame = 0;         ///< of the take, where the track is a part of it
  RotationChart chart;                 ///< of rotations
  std::vector<double> values;          ///< F x 3, the chart's vectors or the positions
  std::vector<std::uint8_t> observed;  ///< F

  Track track() { return {values, 3, observed}; }
  Vec3 at(std::size_t frame) const {
    return {values[3 * frame], values[3 * frame + 1], values[3 * frame + 2]};
  }
  void set(std::size_t frame, Vec3 v) {
    values[3 * frame] = v.x, values[3 * frame + 1] = v.y, values[3 * frame + 2] = v.z;
  }
  Quat rotation(std::size_t frame) const { return chart.rotation_of(frame, at(frame)); }
};

JointTrack rotation_track(const Clip& clip, std::size_t joint);
/// `position`: 0 for joint 0, k + 1 for translated joint k.
JointTrack position_track(const Clip& clip, std::size_t position);

/// Whether the take starts or ends with a span.
struct TakeEnds {
  bool at_start = false, at_end = false;
};

/// The track up to `reach` frames around an observed span, as if that were a gap: nothing of what
/// stands in it is known to the chart. With `ends` also as if the take ended there.
JointTrack hide_span(const JointTrack& track, FrameSpan span, TakeEnds ends, std::size_t reach,
                     double frame_rate_hz);

/// Writes the span back: rotations that the joint's channels can hold (the nearest ones where it
/// has fewer than three), signs continued from the frame before; the samples become observed.
void store_span(const JointTrack& track, FrameSpan span, Clip& clip);

}  // namespace kinemend::fill
