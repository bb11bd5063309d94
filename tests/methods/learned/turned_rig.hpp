// The same motion on a rig whose bones have other axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/take.hpp"

namespace kinemend::test {

/// Turns the frame of each joint by `angle` radians about a random axis.
inline std::vector<Quat> rig_turns(const Take& take, double angle) {
  std::vector<Quat> turns;
  Random random(5);
  for (std::size_t j = 0; j < take.joint_count(); ++j) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const Vec3 axis{x, y, z};
    turns.push_back(exp((angle / norm(axis)) * axis));
  }
  return turns;
}

/// The same motion with other bone axes; world positions and the rest pose are unchanged.
inline Take with_turned_axes(Take take, const std::vector<Quat>& turns) {
  Skeleton& skeleton = take.skeleton;
  for (std::size_t j = 0; j < take.joint_count(); ++j) {
    const std::int32_t parent = skeleton.parents[j];
    const Quat above = parent < 0 ? Quat{} : turns[static_cast<std::size_t>(parent)];
    skeleton.rest_rotations[j] = conjugate(above) * skeleton.rest_rotations[j] * turns[j];
    if (parent >= 0) skeleton.offsets[j] = rotate(conjugate(above), skeleton.offsets[j]);
    for (std::size_t f = 0; f < take.frame_count(); ++f)
      take.rotation(f, j) = conjugate(turns[j]) * take.rotation(f, j) * turns[j];
  }
  for (auto& site : skeleton.end_sites)
    site.offset = rotate(conjugate(turns[static_cast<std::size_t>(site.parent)]), site.offset);
  return take;
}

/// The same motion without rest rotations, as in BVH files: the pose with zero rotations is not a
/// standing person.
inline Take on_turned_rig(const Take& take, const std::vector<Quat>& turns) {
  Take turned = with_turned_axes(take, turns);
  for (std::size_t j = 0; j < take.joint_count(); ++j) {
    const Quat rest = std::exchange(turned.skeleton.rest_rotations[j], Quat{});
    for (std::size_t f = 0; f < take.frame_count(); ++f)
      turned.rotation(f, j) = normalized(rest * turned.rotation(f, j));
  }
  return turned;
}

}  // namespace kinemend::test
