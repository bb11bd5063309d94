// Computes the global positions of joints and end sites (forward kinematics).
#include "kinemend/experimental/kinematics.hpp"

namespace kinemend {

namespace {

// Returns a joint's offset from its parent in one frame.
Vec3 offset_of(const Take& clip, std::size_t frame, std::size_t joint,
               std::size_t& next_translated) {
  if (joint == 0) return clip.root_position(frame);
  const std::size_t width = clip.translated_joints.size();
  if (next_translated < width &&
      clip.translated_joints[next_translated] == static_cast<std::int32_t>(joint)) {
    return clip.position(frame, ++next_translated);
  }
  return clip.skeleton.offsets[joint];
}

void forward_kinematics_into(const Take& clip, std::size_t frame, Pose& pose) {
  const Skeleton& skeleton = clip.skeleton;
  std::size_t next_translated = 0;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const Vec3 offset = offset_of(clip, frame, j, next_translated);
    const Quat local = skeleton.rest_rotations[j] * clip.rotation(frame, j);
    if (skeleton.parents[j] < 0) {
      pose.rotations[j] = local;
      pose.positions[j] = offset;
    } else {
      const auto parent = static_cast<std::size_t>(skeleton.parents[j]);
      pose.rotations[j] = pose.rotations[parent] * local;
      pose.positions[j] = pose.positions[parent] + rotate(pose.rotations[parent], offset);
    }
  }
}

Pose empty_pose(const Take& clip) {
  return {std::vector<Quat>(clip.joint_count()), std::vector<Vec3>(clip.joint_count())};
}

}  // namespace

Pose forward_kinematics(const Take& clip, std::size_t frame) {
  Pose pose = empty_pose(clip);
  forward_kinematics_into(clip, frame, pose);
  return pose;
}

std::vector<Vec3> joint_positions(const Take& clip, bool with_end_sites) {
  const auto& end_sites = clip.skeleton.end_sites;
  const std::size_t width = clip.joint_count() + (with_end_sites ? end_sites.size() : 0);
  std::vector<Vec3> positions;
  positions.reserve(clip.frame_count() * width);
  Pose pose = empty_pose(clip);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    forward_kinematics_into(clip, f, pose);
    positions.insert(positions.end(), pose.positions.begin(), pose.positions.end());
    if (!with_end_sites) continue;
    for (const EndSite& site : end_sites) {
      const auto parent = static_cast<std::size_t>(site.parent);
      positions.push_back(pose.positions[parent] + rotate(pose.rotations[parent], site.offset));
    }
  }
  return positions;
}

}  // namespace kinemend
