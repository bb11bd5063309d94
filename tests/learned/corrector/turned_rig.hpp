// The same motion on a rig whose bones have other axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/experimental/random.hpp"
#include "kinemend/take.hpp"

namespace kinemend::test {

/// How the frame of each joint is turned: by `angle` radians, about an axis of its own.
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

/// All joints are where they were; their frames are turned.
inline Take on_turned_rig(Take take, const std::vector<Quat>& turns) {
  const std::size_t joints = take.joint_count();
  const auto parent_turn = [&](std::size_t j) {
    const std::int32_t parent = take.skeleton.parents[j];
    return parent < 0 ? Quat{} : turns[static_cast<std::size_t>(parent)];
  };
  for (std::size_t j = 1; j < joints; ++j)
    take.skeleton.offsets[j] = rotate(conjugate(parent_turn(j)), take.skeleton.offsets[j]);
  for (auto& site : take.skeleton.end_sites)
    site.offset = rotate(conjugate(turns[static_cast<std::size_t>(site.parent)]), site.offset);
  for (std::size_t f = 0; f < take.frame_count(); ++f)
    for (std::size_t j = 0; j < joints; ++j)
      take.rotation(f, j) = conjugate(parent_turn(j)) * take.rotation(f, j) * turns[j];
  return take;
}

}  // namespace kinemend::test
