// Solves Wahba's problem for joints with several children and takes the smallest turn for one, from
// the roots down.
#include "lab/damage/refit.hpp"

#include <algorithm>
#include <cmath>

#include "kinemend/extend/motion.hpp"
#include "lab/damage/targets.hpp"
#include "motion/rotation.hpp"

namespace kinemend::corrupt {

namespace {

Vec3 any_perpendicular(Vec3 v) {
  const Vec3 other = std::fabs(v.x) < 0.5 * norm(v) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return cross(v, other);
}

Quat smallest_turn(Vec3 from, Vec3 to) {
  const Vec3 a = (1 / norm(from)) * from, b = (1 / norm(to)) * to;
  const double cosine = dot(a, b);
  const Vec3 axis = cross(a, b);
  if (cosine < 0 && norm(axis) < 1e-12) {
    const Vec3 p = any_perpendicular(a);
    return normalized({0, p.x, p.y, p.z});
  }
  return normalized({1 + cosine, axis.x, axis.y, axis.z});
}

// Returns Davenport's matrix K: q^T K q = sum_i to_i . R(q) from_i.
rotation::Matrix4 davenport_matrix(std::span<const Vec3> from, std::span<const Vec3> to) {
  rotation::Matrix4 k{};
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::array<double, 3> o{from[i].x, from[i].y, from[i].z}, v{to[i].x, to[i].y, to[i].z};
    const Vec3 c = cross(from[i], to[i]);
    const std::array<double, 3> z{c.x, c.y, c.z};
    const double trace = dot(from[i], to[i]);
    k[0][0] += trace;
    for (std::size_t r = 0; r < 3; ++r) {
      k[0][r + 1] += z[r];
      k[r + 1][0] += z[r];
      k[r + 1][r + 1] -= trace;
      for (std::size_t s = 0; s < 3; ++s) k[r + 1][s + 1] += v[r] * o[s] + o[r] * v[s];
    }
  }
  return k;
}

// Shifts the eigenvalues above zero, so that the largest also has the largest magnitude.
void make_positive(rotation::Matrix4& k) {
  double square = 0;
  for (const auto& row : k) {
    for (const double entry : row) square += entry * entry;
  }
  for (std::size_t r = 0; r < 4; ++r) k[r][r] += std::sqrt(square);
}

Quat wahba(Quat clean, std::span<const Vec3> from, std::span<const Vec3> to) {
  rotation::Matrix4 k = davenport_matrix(from, to);
  double size = 0;
  for (const Vec3 v : from) size += dot(v, v);
  const double pull = 1e-4 * size;
  const std::array<double, 4> q{clean.w, clean.x, clean.y, clean.z};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t s = 0; s < 4; ++s) k[r][s] += 4 * pull * q[r] * q[s];
  }
  make_positive(k);
  return align_hemisphere(rotation::leading_eigenvector(k, clean), clean);
}

struct Bones {
  std::vector<std::vector<std::size_t>> children;
  std::vector<std::int32_t> translated;  // index in translated_joints, or -1
};

Bones bones_of(const Take& clip) {
  Bones bones{std::vector<std::vector<std::size_t>>(clip.joint_count()),
              std::vector<std::int32_t>(clip.joint_count(), -1)};
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (clip.skeleton.parents[j] >= 0)
      bones.children[static_cast<std::size_t>(clip.skeleton.parents[j])].push_back(j);
  }
  for (std::size_t i = 0; i < clip.translated_joints.size(); ++i) {
    bones.translated[static_cast<std::size_t>(clip.translated_joints[i])] =
        static_cast<std::int32_t>(i);
  }
  return bones;
}

Vec3 offset_of(const Take& clip, const Bones& bones, std::size_t frame, std::size_t joint) {
  if (joint == 0) return clip.root_position(frame);
  if (bones.translated[joint] < 0) return clip.skeleton.offsets[joint];
  return clip.position(frame, 1 + static_cast<std::size_t>(bones.translated[joint]));
}

void refit_frame(Take& clip, const Bones& bones, std::size_t frame, std::span<const Vec3> targets,
                 std::span<const std::uint8_t> may_turn, bool move_root) {
  // Radians, or a share of a length; smaller differences are rounding.
  constexpr double right_enough = 1e-9;
  const Pose clean = forward_kinematics(clip, frame);
  Pose fitted = clean;
  if (move_root) clip.root_position(frame) = targets[0];
  std::vector<Vec3> from, to;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const std::int32_t parent = clip.skeleton.parents[j];
    const Vec3 offset = offset_of(clip, bones, frame, j);
    Quat base = clip.skeleton.rest_rotations[j];
    fitted.positions[j] = offset;
    if (parent >= 0) {
      const auto p = static_cast<std::size_t>(parent);
      base = fitted.rotations[p] * base;
      fitted.positions[j] = fitted.positions[p] + rotate(fitted.rotations[p], offset);
    }
    from.clear();
    to.clear();
    if (may_turn[j]) {
      for (const std::size_t child : bones.children[j]) {
        from.push_back(offset_of(clip, bones, frame, child));
        to.push_back(targets[child] - fitted.positions[j]);
      }
    }
    const bool has_bones =
        std::any_of(from.begin(), from.end(), [](Vec3 v) { return norm(v) > 1e-9; });
    if (has_bones) {
      const Quat local = conjugate(base) * fit_rotation(clean.rotations[j], from, to);
      const Quat old = clip.rotation(frame, j);
      if (angle_between(local, old) > right_enough)
        set_rotation(clip, frame, j, align_hemisphere(local, old));
    }
    fitted.rotations[j] = base * clip.rotation(frame, j);
  }
}

}  // namespace

Quat fit_rotation(Quat clean, std::span<const Vec3> from, std::span<const Vec3> to) {
  // File units; a shorter bone has no direction because of rounding.
  constexpr double no_length = 1e-9;
  std::vector<Vec3> bones, aims;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (norm(from[i]) <= no_length || norm(to[i]) <= no_length) continue;
    bones.push_back(from[i]);
    aims.push_back(to[i]);
  }
  if (bones.empty()) return clean;
  if (bones.size() == 1) return smallest_turn(rotate(clean, bones[0]), aims[0]) * clean;
  return wahba(clean, bones, aims);
}

void refit(Take& clip, std::span<const Vec3> targets, std::span<const std::uint8_t> may_turn,
           bool move_root) {
  const Bones bones = bones_of(clip);
  const std::size_t joints = clip.joint_count();
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    refit_frame(clip, bones, f, targets.subspan(f * joints, joints), may_turn, move_root);
  }
}

}  // namespace kinemend::corrupt
