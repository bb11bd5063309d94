// Tracks of rotations and of vectors with one array for each component, padded for vector loads.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend {

/// Padding after the last frame of a track, so that full vectors can be loaded and stored there.
/// The number of doubles in the widest vectors, by definition.
inline constexpr std::size_t lane_room = 8;

/// Vectors over time, one array per component. The arrays are `lane_room` longer than `frames`.
struct VectorTrack {
  std::size_t frames = 0;
  std::vector<double> x, y, z;

  explicit VectorTrack(std::size_t frame_count = 0);
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
};

/// Rotations of one joint over time, one array per component, initially the identity. The arrays
/// are `lane_room` longer than `frames`.
struct RotationTrack {
  std::size_t frames = 0;
  std::vector<double> w, x, y, z;

  explicit RotationTrack(std::size_t frame_count = 0);
  Quat operator[](std::size_t i) const { return {w[i], x[i], y[i], z[i]}; }
  void set(std::size_t i, Quat q) { w[i] = q.w, x[i] = q.x, y[i] = q.y, z[i] = q.z; }
};

}  // namespace kinemend
