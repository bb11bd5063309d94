// Encodes the rotations of a take as channels that may be filtered, and decodes them.
#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// How a joint's rotation becomes channels that may be filtered.
enum class Encoding : std::uint8_t {
  /// 3 channels per joint: Log(r^-1 q), about the joint's own reference rotation r (its mean).
  /// Continuous from frame to frame even if the angle passes pi; best for joints that stay within a
  /// half turn of their mean.
  tangent,
  /// 4 channels per joint: the unit quaternion with its sign continued from frame to frame. It has
  /// no singularity; decoding projects back to the sphere.
  quaternion,
};

/// The channels of a clip and the data needed to decode them.
struct EncodedClip {
  Encoding encoding = Encoding::tangent;
  std::vector<std::size_t> joints;  ///< the encoded joints, in column order
  std::vector<Quat> references;     ///< one per encoded joint (tangent only)
  bool with_positions = false;  ///< root position columns (3), then joint translations, come last
  std::vector<Vec3> position_references;  ///< subtracted from position columns: their mean
  PoseMatrix poses;  ///< radians (tangent), 1 (quaternion), file units (positions)

  std::size_t channels_per_joint() const noexcept { return encoding == Encoding::tangent ? 3 : 4; }
};

/// Channels in the tangent space are too distorted to be filtered beyond this angle from a joint's
/// mean (150 degrees).
inline constexpr double tangent_limit_rad = 150 * radians_per_degree;

/// Returns the chordal mean of a joint's observed rotations, or its first rotation if none is
/// observed.
Quat mean_rotation(const Take& clip, std::size_t joint);
/// Returns the largest angle (radians, [0, pi]) between a joint's observed rotations and their
/// mean.
double largest_angle_from_mean(const Take& clip, std::size_t joint);
/// Returns `tangent` if the joint stays within `tangent_limit_rad` of its mean, else `quaternion`.
Encoding suitable_encoding(const Take& clip, std::size_t joint);
/// Returns the rotation vector v (1 + 2 pi k / |v|) that is nearest to `previous`; all of them are
/// the same rotation.
Vec3 continue_rotation_vector(Vec3 v, Vec3 previous);

/// Continues the sign of a quaternion from frame to frame, unaffected by noise and jumps: a few
/// outlier frames (more than 60 degrees) do not flip the sign of the motion after them.
class SignContinuation {
 public:
  /// Returns `q` or `-q`. The first quaternion keeps its sign.
  Quat next(Quat q);

 private:
  Quat previous_, steady_;
  int frames_away_ = -1;  // -1: no frame yet
};

/// Returns the channels of the given joints (empty: all). Unobserved samples are encoded unchanged.
/// Errors: `ErrorKind::usage` for a joint that does not exist.
EncodedClip encode(const Take& clip, Encoding encoding, std::vector<std::size_t> joints = {},
                   bool with_positions = true);
/// Writes the channels back into the joints and frames that they came from; `clip` has the same
/// frames and joints.
void decode(const EncodedClip& encoded, Take& clip);

}  // namespace kinemend
