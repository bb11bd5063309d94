// Clips, tracks and settings that the tests of feet share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "feet/body_points.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::test {

inline constexpr feet::Up y_up{Axis::y, 1};

/// Settings that hold every standing foot.
inline FeetSettings forced() {
  FeetSettings settings;
  settings.mode = FeetMode::force;
  return settings;
}

inline Take synthetic_clip(const std::string& motion, double duration_s = 6,
                           double frame_rate_hz = 120, std::uint64_t seed = 1,
                           bool t_pose_first = false) {
  return synthesize({motion, duration_s, frame_rate_hz, seed, t_pose_first});
}

inline std::size_t joint_of(const Take& clip, std::string_view name) {
  return static_cast<std::size_t>(clip.skeleton.find(name));
}

/// Positions of one joint by frame.
inline std::vector<Vec3> track_of(const Take& clip, std::string_view name) {
  const std::vector<Vec3> all = joint_positions(clip);
  std::vector<Vec3> track;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    track.push_back(all[f * clip.joint_count() + joint_of(clip, name)]);
  return track;
}

/// Turns and moves the whole scene: R p + shift.
inline Take moved(Take clip, Quat turn, Vec3 shift, double scale = 1) {
  for (Vec3& offset : clip.skeleton.offsets) offset = scale * offset;
  for (EndSite& site : clip.skeleton.end_sites) site.offset = scale * site.offset;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    clip.root_position(f) = scale * rotate(turn, clip.root_position(f)) + shift;
    clip.rotation(f, 0) = turn * clip.rotation(f, 0);
  }
  return clip;
}

/// Adds a horizontal drift of the root with amplitude `reach` and period `period_s`.
inline Take with_drift(Take clip, double reach, double period_s = 2.5) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double phase = 2 * pi * static_cast<double>(f) / clip.frame_rate_hz / period_s;
    clip.root_position(f) += Vec3{reach * std::sin(phase), 0, reach * std::cos(0.7 * phase)};
  }
  return clip;
}

/// Adds white noise to all rotations.
inline Take with_noise(Take clip, double deg, std::uint64_t seed = 7) {
  Random random(seed);
  for (Quat& q : clip.rotations) {
    const Vec3 turn{random.normal(), random.normal(), random.normal()};
    q = normalized(q * exp(deg * radians_per_degree * turn));
  }
  return clip;
}

/// Adds noise smoothed over a few frames, like the residue of a filter.
inline Take with_smooth_noise(Take clip, double deg, std::uint64_t seed) {
  constexpr std::size_t reach = 3;
  const std::size_t joints = clip.joint_count();
  Random random(seed);
  std::vector<Vec3> noise(clip.rotations.size() + 2 * reach * joints);
  for (Vec3& turn : noise) turn = {random.normal(), random.normal(), random.normal()};
  for (std::size_t i = 0; i < clip.rotations.size(); ++i) {
    Vec3 sum;
    for (std::size_t k = 0; k <= 2 * reach; ++k) sum += noise[i + k * joints];
    const double share = deg * radians_per_degree / std::sqrt(2 * reach + 1.0);
    clip.rotations[i] = normalized(clip.rotations[i] * exp(share * sum));
  }
  return clip;
}

inline bool same_bits(const Take& a, const Take& b, std::size_t frame) {
  for (std::size_t j = 0; j < a.joint_count(); ++j) {
    if (!(a.rotation(frame, j) == b.rotation(frame, j))) return false;
  }
  return a.root_position(frame) == b.root_position(frame);
}

}  // namespace kinemend::test
