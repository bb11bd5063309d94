// Takes and comparisons for the tests of bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::body_test {

inline Take walk(std::string motion = "walk", double duration_s = 4, double frame_rate_hz = 60) {
  return synthesize({std::move(motion), duration_s, frame_rate_hz, 3, false});
}

inline BodyLayout layout_of(const Take& clip) {
  BodyLayoutBuilder builder;
  builder.add(clip);
  return builder.finish();
}

inline BodyChannels channels_of(const BodyLayout& layout, const Take& clip,
                                const NameMap& names = {}) {
  return encode_body(clip, layout, match_body(layout, clip, names));
}

inline double largest_difference(const PoseMatrix& a, const PoseMatrix& b) {
  double largest = a.frames == b.frames && a.channels == b.channels ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.values.size(), b.values.size()); ++i)
    largest = std::max(largest, std::fabs(a.values[i] - b.values[i]));
  return largest;
}

// Root mean square of the difference in the channels of track `track`.
inline double rms_difference(const PoseMatrix& a, const PoseMatrix& b, std::size_t track) {
  double sum = 0;
  for (std::size_t f = 0; f < a.frames; ++f) {
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c)
      sum += (a(f, c) - b(f, c)) * (a(f, c) - b(f, c));
  }
  return std::sqrt(sum / static_cast<double>(a.frames));
}

inline std::size_t track_named(const BodyLayout& layout, std::string_view name) {
  return static_cast<std::size_t>(std::find(layout.names.begin(), layout.names.end(), name) -
                                  layout.names.begin());
}

// The whole take, rotated about its vertical axis, y, and moved.
inline Take moved(Take clip, double heading, Vec3 by) {
  const Quat turn = exp({0, heading, 0});
  if (!clip.has_joints()) {
    for (Vec3& p : clip.positions) p = rotate(turn, p) + by;
    return clip;
  }
  const Quat rest = clip.skeleton.rest_rotations[0];
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    clip.rotation(f, 0) = normalized(conjugate(rest) * turn * rest * clip.rotation(f, 0));
    clip.root_position(f) = rotate(turn, clip.root_position(f)) + by;
  }
  return clip;
}

inline Take renamed(Take clip, const std::map<std::string, std::string>& names) {
  for (std::string& name : clip.skeleton.names) {
    if (const auto found = names.find(name); found != names.end()) name = found->second;
  }
  return clip;
}

inline Vec3 normal_vector(Random& random, double deviation) {
  return {deviation * random.normal(), deviation * random.normal(), deviation * random.normal()};
}

}  // namespace kinemend::body_test
