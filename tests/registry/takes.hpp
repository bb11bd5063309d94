// Small takes with every kind of joint, in closed form.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/take.hpp"

namespace kinemend::test {

/// The joints are hips (position, ZXY), spine (YXZ), arm (XYZ), hinge (X), saddle (Z X), fixed (no
/// channels), and prop (ZXY with translations).
inline Take empty_take(std::size_t frames, double rate_hz) {
  Take clip;
  Skeleton& s = clip.skeleton;
  const auto order = [](const char* text) { return parse_rotation_order(text); };
  s.add_joint("Hips", -1, {}, make_channels(true, order("ZXY")));
  s.add_joint("Spine", 0, {0, 10, 0}, make_channels(false, order("YXZ")));
  s.add_joint("LeftArm", 1, {5, 10, 0}, make_channels(false, order("XYZ")));
  s.add_joint("LeftHinge", 2, {10, 0, 0}, make_channels(false, order("X")));
  s.add_joint("LeftSaddle", 3, {10, 0, 0}, make_channels(false, order("ZX")));
  s.add_joint("Fixed", 1, {0, 10, 0}, {});
  s.add_joint("Prop", 0, {0, 0, 20}, make_channels(true, order("ZXY")));
  clip.frame_rate_hz = rate_hz;
  clip.translated_joints = {6};
  for (std::size_t f = 0; f < frames; ++f)
    clip.positions.insert(clip.positions.end(), {{0, 100, 0}, {0, 0, 20}});
  clip.rotations.assign(frames * s.joint_count(), {});
  return clip;
}

/// Returns whether a method runs live without lookahead, and so lags behind the motion.
inline bool runs_without_delay(const Cleaner& cleaner) {
  const Take like = empty_take(0, 120);
  return cleaner.live_support(120).runs() && cleaner.live(view_of(like))->lookahead() == 0;
}

/// Rotation of joint `joint` of the moving take at `time_s`.
inline Quat motion_at(std::size_t joint, double time_s) {
  const double a = std::sin(2 * pi * 0.8 * time_s + 0.7 * static_cast<double>(joint));
  const double b = std::sin(2 * pi * 1.3 * time_s + static_cast<double>(joint));
  switch (joint) {
    case 0:
      return exp({0, 1.2 * time_s, 0}) * exp({0.2 * a, 0, 0.1 * b});
    case 3:
      return from_euler({0.8 + 0.6 * a, 0, 0}, parse_rotation_order("X"));
    case 4:
      return from_euler({0.5 * a, 0.4 * b, 0}, parse_rotation_order("ZX"));
    case 5:
      return {};
    default:
      return exp({0.5, 0.2, -0.3}) * exp({0.7 * a, 0.3 * b, 0.4 * a * b});
  }
}

inline Take moving_take(std::size_t frames, double rate_hz) {
  Take clip = empty_take(frames, rate_hz);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / rate_hz;
    for (std::size_t j = 0; j < clip.joint_count(); ++j) clip.rotation(f, j) = motion_at(j, t);
    clip.root_position(f) = {50 * t, 100 + 3 * std::sin(9 * t), 10 * std::cos(3 * t)};
    clip.position(f, 1) = {2 * std::sin(5 * t), 0, 20 + std::cos(4 * t)};
  }
  return clip;
}

/// Adds white noise per axis to every joint with three axes and to the positions (file units).
inline void add_noise(Take& clip, double noise_deg, double noise_position, std::uint64_t seed) {
  Random random(seed);
  const auto noise = [&random](double size) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return Vec3{size * x, size * y, size * z};
  };
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const Vec3 v = noise(noise_deg * radians_per_degree);
      const RotationOrder order = clip.skeleton.rotation_order(j);
      if (order.count == 0) continue;
      const Quat q = clip.rotation(f, j) * exp(v);
      clip.rotation(f, j) = order.count == 3 ? q : from_euler(to_euler(q, order), order);
    }
    for (std::size_t i = 0; i < clip.point_count(); ++i) {
      clip.position(f, i) += noise(noise_position);
    }
  }
}

inline double rms_angle_deg(const Take& a, const Take& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rotations.size(); ++i) {
    sum += std::pow(angle_between(a.rotations[i], b.rotations[i]), 2);
  }
  return std::sqrt(sum / static_cast<double>(a.rotations.size())) * degrees_per_radian;
}

inline double max_angle_deg(const Take& a, const Take& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rotations.size(); ++i) {
    largest = std::max(largest, angle_between(a.rotations[i], b.rotations[i]));
  }
  return largest * degrees_per_radian;
}

/// Methods that work on any body; those with a learned model have separate tests.
inline std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    if (!method.learned) names.push_back(method.name);
  }
  return names;
}

/// Methods among these that are causal by default and lag behind the motion.
inline std::vector<std::string> causal_method_names() {
  std::vector<std::string> names = method_names();
  std::erase_if(names,
                [](const std::string& name) { return !runs_without_delay(*make_cleaner(name)); });
  return names;
}

/// Methods among these that look ahead.
inline std::vector<std::string> other_method_names() {
  std::vector<std::string> names = method_names();
  for (const std::string& causal : causal_method_names()) std::erase(names, causal);
  return names;
}

/// A test name from a method's name.
inline std::string camel_case(std::string_view name) {
  std::string text;
  bool upper = true;
  for (const char c : name) {
    if (c == '-') {
      upper = true;
      continue;
    }
    text += upper ? static_cast<char>(std::toupper(c)) : c;
    upper = false;
  }
  return text;
}
inline std::string test_name_of(const testing::TestParamInfo<std::string>& method) {
  return camel_case(method.param);
}

}  // namespace kinemend::test
