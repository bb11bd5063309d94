// The points of a body that the method `sparse` knows, from a body's channels and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/pose_matrix.hpp"
#include "kinemend/rotation.hpp"

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

}  // namespace kinemend
