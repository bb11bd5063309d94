// Marker takes with known ground truth.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"
#include "motion/random_rotations.hpp"

namespace kinemend::test {

/// Markers on a synthetic body, two on each joint that carries a bone, in millimetres, all
/// observed.
inline Take marker_take(const std::string& motion = "walk", double duration_s = 2,
                        double rate_hz = 120) {
  SynthOptions options;
  options.motion = motion;
  options.duration_s = duration_s;
  options.frame_rate_hz = rate_hz;
  const Take clip = synthesize(options);
  std::vector<std::size_t> joints;
  std::vector<std::string> names;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const std::string& name = clip.skeleton.names[j];
    if (name.find("Thumb") != std::string::npos || name.find("Finger") != std::string::npos)
      continue;
    joints.push_back(j);
    names.push_back(name + "1");
    names.push_back(name + "2");
  }
  Take take = make_marker_take(names, clip.frame_count(), rate_hz);
  take.unit = "mm";
  take.observed.assign(take.positions.size(), 1);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Pose pose = forward_kinematics(clip, f);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Quat turn = pose.rotations[joints[i]];
      const Vec3 joint = pose.positions[joints[i]];
      take.position(f, 2 * i) = 10.0 * (joint + rotate(turn, {4, 2, 3}));
      take.position(f, 2 * i + 1) = 10.0 * (joint + rotate(turn, {-3, 5, -4}));
    }
  }
  return take;
}

/// Adds white noise per axis, and moves `outlier_share` of the samples by `outlier` in random
/// directions.
inline Take damaged(Take clip, double noise, double outlier_share, double outlier,
                    std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i] == 0) continue;
    clip.positions[i] += random_vector(random, noise);
    if (!random.chance(outlier_share)) continue;
    const Vec3 direction = random_vector(random, 1);
    clip.positions[i] += (outlier / norm(direction)) * direction;
  }
  return clip;
}

/// Root mean square distance of the samples observed in both takes.
inline double rms_distance(const Take& a, const Take& b) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    if (a.observed[i] == 0 || b.observed[i] == 0) continue;
    const Vec3 d = a.positions[i] - b.positions[i];
    sum += dot(d, d);
    count += 1;
  }
  return std::sqrt(sum / count);
}

inline double max_distance(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    if (a.observed[i] != 0 && b.observed[i] != 0)
      largest = std::max(largest, norm(a.positions[i] - b.positions[i]));
  }
  return largest;
}

/// Hides the samples of one marker.
inline void lose(Take& clip, std::size_t marker, std::size_t first, std::size_t last) {
  for (std::size_t f = first; f <= last; ++f) {
    clip.observed[f * clip.marker_count() + marker] = 0;
    clip.position(f, marker) = {};
  }
}

}  // namespace kinemend::test
