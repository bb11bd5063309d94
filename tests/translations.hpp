// Reads and adds the positions of a clip, track by track.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::test {

/// One track of the positions by frame: 0 is the root, k + 1 is translated joint k.
inline std::vector<Vec3> point_track(const Take& clip, std::size_t track) {
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) points.push_back(clip.position(f, track));
  return points;
}

/// Makes `joints` the translated joints of a clip. `at(f, k)` gives the translation of joints[k] in
/// frame f and is called in this order.
template <class At>
void add_translations(Take& clip, std::vector<std::int32_t> joints, const At& at) {
  const std::vector<Vec3> roots = point_track(clip, 0);
  clip.positions.clear();
  for (std::size_t f = 0; f < roots.size(); ++f) {
    clip.positions.push_back(roots[f]);
    for (std::size_t k = 0; k < joints.size(); ++k) clip.positions.push_back(at(f, k));
  }
  clip.translated_joints = std::move(joints);
}

/// Adds the same translation to all frames.
inline void add_translations(Take& clip, std::vector<std::int32_t> joints, Vec3 translation) {
  add_translations(clip, std::move(joints), [&](std::size_t, std::size_t) { return translation; });
}

}  // namespace kinemend::test
