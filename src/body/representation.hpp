// Turns one track of rotations into channels and back.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "kinemend/extend/body.hpp"

namespace kinemend {

/// A continued vector or angle of a rotation may leave its steady value by this much (radians); if
/// it stays farther away for longer than this, the steady value follows. Chosen by hand, not swept.
inline constexpr double steady_rad = pi / 3;
inline constexpr int patience_frames = 12;

/// A rotation vector continues beyond half a turn, but no joint that models know makes a full turn.
/// Radians; chosen by hand, not swept.
inline constexpr double farthest_turn_rad = 210 * radians_per_degree;
/// Returns `v`, or the vector of the same rotation that is near `last` if it is not too long.
inline Vec3 continue_within_a_turn(Vec3 v, Vec3 last) {
  const Vec3 next = continue_rotation_vector(v, last);
  return norm(next) > farthest_turn_rad ? v : next;
}

/// Whether a quaternion is a rotation up to rounding: its squared length is near 1.
inline bool is_nearly_unit(Quat q) {
  constexpr double near = 0.1;  // chosen by hand, not swept
  return std::abs(dot(q, q) - 1) < near;
}

/// Returns the number of channels of one joint in an encoding.
inline std::size_t channels_of(Encoding encoding) { return encoding == Encoding::tangent ? 3 : 4; }

/// Returns the chordal mean of the observed samples (`observed` empty: all), or the first sample if
/// none is observed.
Quat mean_rotation(std::span<const Quat> track, std::span<const std::uint8_t> observed);
/// Returns `tangent` if the observed samples stay within `tangent_limit_rad` of their mean.
Encoding suitable_encoding(std::span<const Quat> track, std::span<const std::uint8_t> observed);

/// Writes the track into the channels from `first` on; `reference` is used in the tangent space
/// only.
void encode_rotations(std::span<const Quat> track, Encoding encoding, Quat reference,
                      PoseMatrix& channels, std::size_t first);
/// Returns frame `frame` of the channels that `encode_rotations` wrote.
Quat decode_rotation(const PoseMatrix& channels, Encoding encoding, Quat reference,
                     std::size_t frame, std::size_t first);

}  // namespace kinemend
