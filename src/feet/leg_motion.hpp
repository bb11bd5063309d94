// The legs of a clip, frame by frame, as the cleaning steps use them, and the blocks of frames on
// which they run in parallel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "feet/body_points.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::feet {

/// A joint of a leg with the file's channels.
struct LegJoint {
  std::size_t index = 0;
  Quat rest;
  RotationOrder order;
};

/// Constants of a leg.
struct LegModel {
  LegJoint hip, knee, ankle;
  std::array<Vec3, 2> sole;             ///< by `FootPart`, in the ankle's frame
  std::array<bool, 2> has{true, true};  ///< by `FootPart`
  Vec3 hinge;                           ///< usual axis of the knee in its parent's frame, unit
};

/// A leg in one frame, in the world.
struct LegPose {
  Quat hip_parent, hip, knee_parent, knee, ankle_parent, ankle;
  Vec3 hip_at, knee_at, ankle_at;

  Vec3 sole_at(const LegModel& model, FootPart part) const {
    return ankle_at + rotate(ankle, model.sole[static_cast<std::size_t>(part)]);
  }
};

/// The joint whose position channels move the whole body.
struct Carrier {
  bool found = false;
  std::size_t joint = 0;
  std::size_t track = 0;        ///< 0: the root position, k + 1: translated joint k
  std::vector<Quat> frames_of;  ///< F: the frame of reference of its position
  std::vector<Vec3> at;         ///< F: its position in the world
};

/// The legs of a clip: F frames of L legs.
struct LegMotion {
  std::size_t frames = 0;
  double frame_rate_hz = 0;
  double height = 0;  ///< of the body, file units
  std::vector<LegModel> models;
  std::vector<LegPose> poses;  ///< F x L
  Carrier carrier;

  std::size_t legs() const { return models.size(); }
  LegPose& pose(std::size_t frame, std::size_t leg) { return poses[frame * legs() + leg]; }
  const LegPose& pose(std::size_t frame, std::size_t leg) const {
    return poses[frame * legs() + leg];
  }
  /// Returns the mean of the hips.
  Vec3 hips_at(std::size_t frame) const;
};

/// Returns the legs without the heels of feet that have none in the skeleton; these need
/// `set_heels`.
LegMotion leg_motion(const Take& clip, const std::vector<Leg>& legs);
/// Updates the poses with the given models.
void update_poses(const Take& clip, const std::vector<Leg>& legs, LegMotion& motion);

/// Returns the axis along which the body is above its feet; `wanted` if given.
std::optional<Up> up_of(const LegMotion& motion, std::optional<Axis> wanted);
/// Adds a heel if the skeleton has none, from the frames in which the foot is flat.
void set_heels(const Take& clip, Up up, LegMotion& motion);

/// Returns heel and toe of each leg as points 2 l and 2 l + 1, with the mean of the hips as the
/// body's centre; the heel represents a missing toe.
BodyPoints sole_points(const LegMotion& motion);

/// Calls work(first, end) for blocks that together are [first, end), in any order and in several
/// threads.
template <class Work>
void for_blocks(std::size_t first, std::size_t end, const Work& work) {
  // For speed, not swept.
  constexpr std::size_t least = 256;  // frames, a share of work
  for_each_range(first, end, least, work);
}

}  // namespace kinemend::feet
