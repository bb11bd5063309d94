// Turns one track of rotations into channels and back.
#pragma once

#include <cstddef>
#include <span>

#include "kinemend/experimental/representation.hpp"

namespace kinemend {

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
