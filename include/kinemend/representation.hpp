#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/pose_matrix.hpp"

namespace kinemend {

/// How a joint's rotation becomes channels that may be filtered.
enum class Encoding : std::uint8_t {
  /// 3 channels a joint: Log(r^-1 q), about a reference rotation r of the joint's own (its mean).
  /// Continuous from frame
  /// to frame also where the angle passes pi; best for joints that stay within a half turn of their
  /// mean.
  tangent,
  /// 4 channels a joint: the unit quaternion with its sign continued from frame to frame. No
  /// singularity
  /// anywhere; decoding projects back to the sphere.
  quaternion,
};

/// The channels of a clip and what is needed to read them back.
struct EncodedClip {
  Encoding encoding = Encoding::tangent;
  std::vector<std::size_t> joints;  ///< those encoded, in column order
  std::vector<Quat> references;     ///< one a joint encoded (tangent only)
  bool with_positions = false;  ///< root position columns (3), then joint translations, come last
  std::vector<Vec3> position_references;  ///< subtracted from position columns: their mean
  PoseMatrix poses;  ///< radians (tangent), 1 (quaternion), file units (positions)

  std::size_t channels_per_joint() const noexcept { return encoding == Encoding::tangent ? 3 : 4; }
};

/// `joints` empty means all.
EncodedClip encode(const Clip& clip, Encoding encoding, std::vector<std::size_t> joints = {},
                   bool with_positions = true);
/// Writes the channels back into the joints and frames they came from; `clip` has the same frames
/// and joints.
void decode(const EncodedClip& encoded, Clip& clip);

}  // namespace kinemend
