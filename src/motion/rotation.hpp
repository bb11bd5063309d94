// Extends the rotations and vectors of `kinemend/rotation.hpp`: components and unit vectors by
// axis, vectors of a matrix of channels, steps between samples, charts of rotations for linear
// filters, and the eigenvector behind means.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// x, y or z of a vector: axis 0, 1 or 2.
inline double component(Vec3 v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
inline double& component_of(Vec3& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

inline double component(Vec3 v, Axis axis) { return component(v, static_cast<std::size_t>(axis)); }
inline double& component_of(Vec3& v, Axis axis) {
  return component_of(v, static_cast<std::size_t>(axis));
}
inline Vec3 unit_vector(Axis axis) {
  return {axis == Axis::x ? 1.0 : 0.0, axis == Axis::y ? 1.0 : 0.0, axis == Axis::z ? 1.0 : 0.0};
}

/// The channels 3 part, 3 part + 1 and 3 part + 2 of a frame.
inline Vec3 vector_at(const PoseMatrix& values, std::size_t frame, std::size_t part) {
  return {values(frame, 3 * part), values(frame, 3 * part + 1), values(frame, 3 * part + 2)};
}

inline Vec3 difference(Quat from, Quat to) { return log(conjugate(from) * to); }
inline Vec3 difference(Vec3 from, Vec3 to) { return to - from; }
inline Quat moved(Quat from, Vec3 by) { return from * exp(by); }
inline Vec3 moved(Vec3 from, Vec3 by) { return from + by; }

/// Rotations of one joint as vectors in radians, without a singularity however far the joint turns:
/// the increments Log(b[t]^-1 b[t+1]) of a reference b sum to a path in R^3, and a rotation q[t] is
/// the path's point plus the offset Log(b[t]^-1 q[t]). White noise on a rotation is the same noise
/// on its vector as long as the offsets are small.
struct RotationChart {
  std::vector<Quat> reference;  ///< b, F
  std::vector<Vec3> path;       ///< F

  Vec3 vector_of(std::size_t frame, Quat rotation) const {
    return path[frame] + log(conjugate(reference[frame]) * rotation);
  }
  Quat rotation_of(std::size_t frame, Vec3 vector) const {
    return normalized(reference[frame] * exp(vector - path[frame]));
  }
};

}  // namespace kinemend

namespace kinemend::rotation {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Returns the unit eigenvector of the largest eigenvalue of a symmetric positive semidefinite
/// matrix, up to sign. If the largest eigenvalue is repeated, any vector of its space. `fallback`
/// if the matrix is zero.
Quat leading_eigenvector(Matrix4 matrix, Quat fallback = {});

}  // namespace kinemend::rotation
