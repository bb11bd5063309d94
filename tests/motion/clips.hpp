// Small skeletons and clips in closed form, for tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "kinemend/take.hpp"
#include "motion/random_rotations.hpp"

namespace kinemend::test {

inline constexpr double degree = radians_per_degree;

inline Quat about_x(double angle) { return exp({angle, 0, 0}); }
inline Quat about_y(double angle) { return exp({0, angle, 0}); }
inline Quat about_z(double angle) { return exp({0, 0, angle}); }

// All joints rest, with the root at its offset.
inline Take resting_clip(Skeleton skeleton, std::size_t frames, double frame_rate_hz) {
  Take clip;
  clip.frame_rate_hz = frame_rate_hz;
  clip.positions.assign(frames, skeleton.offsets[0]);
  clip.rotations.assign(frames * skeleton.joint_count(), Quat{});
  clip.skeleton = std::move(skeleton);
  return clip;
}

// The chain root -> joint1 -> joint2 ..., each one unit along x from its parent, with an end site
// and ZXY channels.
inline Skeleton chain_skeleton(std::size_t joints) {
  Skeleton skeleton;
  const RotationOrder order = parse_rotation_order("ZXY");
  skeleton.add_joint("root", -1, {0, 0, 0}, make_channels(true, order));
  for (std::size_t j = 1; j < joints; ++j) {
    skeleton.add_joint("joint" + std::to_string(j), static_cast<std::int32_t>(j) - 1, {1, 0, 0},
                       make_channels(false, order));
  }
  skeleton.end_sites.push_back({static_cast<std::int32_t>(joints) - 1, {1, 0, 0}, ""});
  return skeleton;
}

inline Take chain_clip(std::size_t joints, std::size_t frames, double frame_rate_hz = 100) {
  return resting_clip(chain_skeleton(joints), frames, frame_rate_hz);
}

// Smooth motion of every joint of a chain: sums of slow sines, different for each joint and axis.
inline Take moving_chain(std::size_t joints, std::size_t frames, double frame_rate_hz = 100) {
  Take clip = chain_clip(joints, frames, frame_rate_hz);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / frame_rate_hz;
    clip.root_position(f) = {t, 1 + 0.1 * std::sin(5 * t), 0.2 * t};
    for (std::size_t j = 0; j < joints; ++j) {
      const double k = 1 + 0.3 * static_cast<double>(j);
      clip.rotation(f, j) =
          exp({0.5 * std::sin(k * 3 * t), 0.3 * std::cos(k * 2 * t), 0.4 * std::sin(k * t + 1)});
    }
  }
  return clip;
}

}  // namespace kinemend::test
