// Encodes the rotations of a take as channels that may be filtered, and decodes them.
#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
#include "kinemend/take.hpp"

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

/// Farther than this from a joint's mean (150 degrees), channels in the tangent space bend too much
/// to be filtered.
inline constexpr double tangent_limit_rad = 150 * radians_per_degree;

/// Chordal mean of a joint's observed rotations; its first rotation when none is observed.
Quat mean_rotation(const Take& clip, std::size_t joint);
/// Largest angle (radians, [0, pi]) between a joint's observed rotations and their mean.
double largest_angle_from_mean(const Take& clip, std::size_t joint);
/// `tangent` where the joint stays within `tangent_limit_rad` of its mean, else `quaternion`.
Encoding suitable_encoding(const Take& clip, std::size_t joint);
/// Of the rotation vectors v (1 + 2 pi k / |v|), which all mean the same rotation, the one nearest
/// to `previous`.
Vec3 continue_rotation_vector(Vec3 v, Vec3 previous);

/// Continues the sign of a quaternion from frame to frame, so that noise and jumps leave it alone:
/// a few frames that are thrown far off (more than 60 degrees) do not turn the sign of the motion
/// that goes on after them.
class SignContinuation {
 public:
  /// `q` or `-q`. The first one is taken as it is.
  Quat next(Quat q);

 private:
  Quat previous_, steady_;
  int frames_away_ = -1;  // -1: nothing came yet
};

/// The channels of the given joints (empty: all). Unobserved samples are encoded as they stand.
/// Errors: `ErrorKind::usage` for a joint that is not there.
EncodedClip encode(const Take& clip, Encoding encoding, std::vector<std::size_t> joints = {},
                   bool with_positions = true);
/// Writes the channels back into the joints and frames they came from; `clip` has the same frames
/// and joints.
void decode(const EncodedClip& encoded, Take& clip);

}  // namespace kinemend
