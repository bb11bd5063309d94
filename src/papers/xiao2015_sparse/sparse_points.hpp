// Converts a body's channels to the points that the method `sparse` knows, and back. Poses are in
// the local coordinates of Xiao et al. 2015, section 3.1.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// P points, in body heights. For joints the first N are the joints themselves, on a body with the
/// mean limb lengths of the training, whatever those of the take are; the others are the free ends
/// of bones. For markers they are the markers.
struct SparsePoints {
  BodyKind kind = BodyKind::joints;
  std::vector<std::int32_t> parents;  ///< P, joints: the track that carries the point; -1: none
  /// P; joints: from its parent at rest, in the parent's frame; markers: the mean position.
  std::vector<Vec3> offsets;

  std::size_t count() const noexcept { return offsets.size(); }
};

/// Averages the vectors from joints to their children over takes; one frame of each is enough.
class SparsePointsBuilder {
 public:
  explicit SparsePointsBuilder(const BodyLayout& layout);
  void add(const Take& clip);
  SparsePoints finish() const;

 private:
  const BodyLayout& layout_;
  std::vector<Vec3> sums_;
  std::vector<double> counts_;
};
/// The points of a marker layout, which determines them fully.
SparsePoints marker_points(const BodyLayout& layout);

/// F x 3 P positions; for joints the first joint is at the origin.
PoseMatrix points_of(const SparsePoints& points, const BodyLayout& layout,
                     const PoseMatrix& channels);
/// F x 3 P: whether a point was measured, that is, all joints above it.
std::vector<std::uint8_t> observed_points(const SparsePoints& points, const BodyLayout& layout,
                                          const std::vector<std::uint8_t>& observed);

/// The channels of a body whose points are as close as possible to `positions` (F x 3 P), from the
/// root outward: each joint turns its bones towards those of `positions`, by the rotation R that
/// minimises
///
///     sum over its points of |R offset - (position - joint)|^2 + stiffness^2 |R - R_0|^2
///
/// R_0 is its rotation in `guide` (F x D) on the new pose of the joint above. It determines the
/// twist about a single bone, which positions do not. Bone lengths are kept, as only rotations
/// change. Channels without points below them, among them the place, keep the guide's values.
PoseMatrix channels_of(const SparsePoints& points, const BodyLayout& layout,
                       const PoseMatrix& positions, const PoseMatrix& guide,
                       double stiffness = 0.2);

/// The points that define a pose's frame; -1: the body has none. Without a root, poses stay in the
/// frame of the body; without one of the others they are only translated.
struct LocalPoints {
  std::int32_t root = -1;
  std::int32_t left_hip = -1, right_hip = -1, neck = -1;
};

/// x_local = turn (x - origin)
struct LocalFrame {
  Quat turn;
  Vec3 origin;
};

/// The frame of each pose of `positions` (F x 3 P): the root at the origin, the plane of the hips
/// and the neck parallel to XY, the ray from between the hips to the neck along +Y, the left hip at
/// +X. If the three are nearly on a line or a point, the frame is turned as in the last pose in
/// which they are not (before the first such pose, as in that one).
std::vector<LocalFrame> local_frames(const PoseMatrix& positions, const LocalPoints& points);

/// Convert to local coordinates and back, exactly.
void to_local(const std::vector<LocalFrame>& frames, PoseMatrix& positions);
void from_local(const std::vector<LocalFrame>& frames, PoseMatrix& positions);

}  // namespace kinemend
