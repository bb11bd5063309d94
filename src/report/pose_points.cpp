// Computes points and bones of poses for drawings of bodies.
#include "report/pose_points.hpp"

#include "kinemend/experimental/kinematics.hpp"
#include "motion/component.hpp"

namespace kinemend {

namespace {

Poses poses_of_joints(const Take& clip, const std::vector<std::size_t>& frames) {
  Poses poses;
  const Skeleton& skeleton = clip.skeleton;
  for (std::size_t j = 1; j < skeleton.joint_count(); ++j) {
    if (skeleton.parents[j] >= 0)
      poses.bones.emplace_back(static_cast<std::size_t>(skeleton.parents[j]), j);
  }
  for (std::size_t e = 0; e < skeleton.end_sites.size(); ++e) {
    poses.bones.emplace_back(static_cast<std::size_t>(skeleton.end_sites[e].parent),
                             skeleton.joint_count() + e);
  }
  for (const std::size_t frame : frames) {
    const Pose pose = forward_kinematics(clip, frame);
    auto& points = poses.moments.emplace_back(pose.positions.begin(), pose.positions.end());
    for (const EndSite& end : skeleton.end_sites) {
      const auto parent = static_cast<std::size_t>(end.parent);
      points.emplace_back(pose.positions[parent] + rotate(pose.rotations[parent], end.offset));
    }
  }
  return poses;
}

}  // namespace

Poses poses_of(const Take& clip, const std::vector<std::size_t>& frames) {
  if (clip.has_joints()) return poses_of_joints(clip, frames);
  Poses poses;
  for (const std::size_t frame : frames) {
    auto& points = poses.moments.emplace_back();
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      const bool is_seen = clip.is_observed(frame, m) && clip.holds_positions(m);
      points.push_back(is_seen ? std::optional(clip.position(frame, m)) : std::nullopt);
    }
  }
  return poses;
}

Range range_of(const std::vector<std::optional<Vec3>>& points, std::size_t axis) {
  Range range;
  for (const auto& point : points) {
    if (point) range.add(component(*point, axis));
  }
  return range;
}

}  // namespace kinemend
