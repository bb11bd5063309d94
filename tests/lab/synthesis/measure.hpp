// Makes synthetic motions and measures them, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::measure {

inline Take make(std::string motion, double duration_s = 6, double rate_hz = 120,
                 std::uint64_t seed = 1) {
  return synthesize({std::move(motion), duration_s, rate_hz, seed, false});
}

/// Positions of one joint over the clip.
inline std::vector<Vec3> track(const Take& clip, std::string_view joint) {
  const auto j = static_cast<std::size_t>(clip.skeleton.find(joint));
  const std::vector<Vec3> all = joint_positions(clip);
  std::vector<Vec3> result;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    result.push_back(all[f * clip.joint_count() + j]);
  return result;
}

inline double horizontal(Vec3 a, Vec3 b) { return std::hypot(a.x - b.x, a.z - b.z); }

/// Norms of the first differences times the rate.
inline std::vector<double> speeds(const std::vector<Vec3>& track, double rate_hz) {
  std::vector<double> result;
  for (std::size_t f = 1; f < track.size(); ++f)
    result.push_back(rate_hz * norm(track[f] - track[f - 1]));
  return result;
}

inline double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}
inline double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

/// Rotation about the joint's x axis in degrees, in [-180, 180): the twist of the rotation about x.
inline std::vector<double> turn_about_x(const Take& clip, std::string_view joint) {
  const auto j = static_cast<std::size_t>(clip.skeleton.find(joint));
  std::vector<double> result;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Quat q = clip.rotation(f, j);
    result.push_back(wrap_angle(2 * std::atan2(q.x, q.w) * degrees_per_radian, 180));
  }
  return result;
}

/// Frames [first, last) in which a foot rests.
struct Rest {
  std::size_t first, last;
};

/// Runs of frames, `shortest` or more, in which the joint is within 0.02 cm of its lowest height.
inline std::vector<Rest> rests(const std::vector<Vec3>& track, std::size_t shortest) {
  double floor = track[0].y;
  for (Vec3 p : track) floor = std::min(floor, p.y);
  std::vector<Rest> result;
  for (std::size_t f = 0; f < track.size(); ++f) {
    if (track[f].y > floor + 0.02) continue;
    const std::size_t first = f;
    while (f < track.size() && track[f].y <= floor + 0.02) ++f;
    if (f - first >= shortest) result.push_back({first, f});
  }
  return result;
}

}  // namespace kinemend::measure
