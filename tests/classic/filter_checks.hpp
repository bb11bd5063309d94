// Tracks and differences shared by the tests of orientation filters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"
#include "motion/random_rotations.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {

/// The rotations of a joint, frame by frame.
inline std::vector<Quat> track_of(const Take& clip, std::size_t joint) {
  std::vector<Quat> track;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) track.push_back(clip.rotation(f, joint));
  return track;
}

/// Distance of quaternions up to sign; near 0 it keeps digits that an angle loses.
inline double difference(Quat a, Quat b) { return std::min(norm(a + -b), norm(a + b)); }

inline double largest_difference(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rotations.size(); ++i) {
    largest = std::max(largest, difference(a.rotations[i], b.rotations[i]));
  }
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    largest = std::max(largest, norm(a.positions[i] - b.positions[i]));
  }
  return largest;
}

inline Take cleaned(Take clip, const Cleaner& cleaner) {
  clean_in_place(cleaner, clip);
  return clip;
}

/// The moving take with added noise.
inline Take noisy_take(std::size_t frames, double rate_hz = 100, double noise_deg = 2,
                       std::uint64_t seed = 1) {
  Take clip = moving_take(frames, rate_hz);
  add_noise(clip, noise_deg, 0.5, seed);
  return clip;
}

/// Replaces every rotation q by a q b, with separate random a and b for each joint.
inline Take in_other_frames(Take clip, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const Quat a = random_rotation(random), b = random_rotation(random);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      clip.rotation(f, j) = normalized(a * clip.rotation(f, j) * b);
    }
  }
  return clip;
}

inline Take reversed(const Take& clip) {
  Take result = clip;
  const std::size_t frames = clip.frame_count();
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      result.rotation(f, j) = clip.rotation(frames - 1 - f, j);
    }
    for (std::size_t i = 0; i < clip.point_count(); ++i) {
      result.position(f, i) = clip.position(frames - 1 - f, i);
    }
  }
  return result;
}

/// Changes the take in frame f.
inline Take changed_at(Take clip, std::size_t f) {
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    clip.rotation(f, j) = clip.rotation(f, j) * exp({0.3, -0.2, 0.1});
  }
  clip.root_position(f) += {1, 2, 3};
  return clip;
}

/// A take of one joint at a constant random rotation with white noise.
inline Take held_take(std::size_t frames, double noise_deg, std::uint64_t seed) {
  Take clip;
  clip.skeleton.add_joint("joint", -1, {0, 1, 0}, make_channels(true, parse_rotation_order("ZXY")));
  clip.frame_rate_hz = 100;
  clip.positions.assign(frames, {});
  Random random(seed);
  for (std::size_t f = 0; f < frames; ++f) {
    clip.rotations.push_back(exp({0.4, -1, 0.2}) *
                             exp(random_vector(random, noise_deg * radians_per_degree)));
  }
  return clip;
}

}  // namespace kinemend::test
