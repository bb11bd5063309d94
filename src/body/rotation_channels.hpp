// Turns one track of rotations into channels and back.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "kinemend/experimental/representation.hpp"

namespace kinemend {

/// Where a vector or an angle of a rotation is continued, so far it may be from where it steadily
/// was (radians), and so long it may stay farther away before that is where it steadily is. Chosen
/// by hand, not swept.
inline constexpr double steady_rad = pi / 3;
inline constexpr int patience_frames = 12;

/// Past half a turn a rotation vector goes on, but no joint that models know has turned once round.
/// Radians; chosen by hand, not swept.
inline constexpr double farthest_turn_rad = 210 * radians_per_degree;
/// `v`, or the vector of the same rotation that is near to `last` and not too long.
inline Vec3 continue_within_a_turn(Vec3 v, Vec3 last) {
  const Vec3 next = continue_rotation_vector(v, last);
  return norm(next) > farthest_turn_rad ? v : next;
}

/// Whether a quaternion is a rotation, up to rounding: its squared length is near 1.
inline bool is_nearly_unit(Quat q) {
  constexpr double near = 0.1;  // chosen by hand, not swept
  return std::abs(dot(q, q) - 1) < near;
}

/// Channels of one joint in an encoding.
inline std::size_t channels_of(Encoding encoding) { return encoding == Encoding::tangent ? 3 : 4; }

/// Chordal mean of the observed samples (`observed` empty: all); the first sample where none was.
Quat mean_rotation(std::span<const Quat> track, std::span<const std::uint8_t> observed);
/// `tangent` where the observed samples stay within `tangent_limit_rad` of their mean.
Encoding suitable_encoding(std::span<const Quat> track, std::span<const std::uint8_t> observed);

/// Writes the track into the channels from `first` on; `reference` counts in the tangent space
/// only.
void encode_rotations(std::span<const Quat> track, Encoding encoding, Quat reference,
                      PoseMatrix& channels, std::size_t first);
/// Frame `frame` of what `encode_rotations` wrote.
Quat decode_rotation(const PoseMatrix& channels, Encoding encoding, Quat reference,
                     std::size_t frame, std::size_t first);

}  // namespace kinemend
