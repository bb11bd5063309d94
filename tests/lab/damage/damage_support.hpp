// Damages clips and measures the errors, for tests of damages.
#pragma once

#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "kinemend/lab/corrupt.hpp"
#include "motion/clips.hpp"
#include "noise_measures.hpp"

namespace kinemend::test {

struct Damaged {
  Take clip;
  DamageReport report;
};

inline Damaged damaged(const Take& clean, std::string_view name, const OptionValues& values = {},
                       std::uint64_t seed = 1) {
  Damaged result{clean, {}};
  Random random(seed);
  result.report = apply_damage(result.clip, name, values, random);
  return result;
}

inline bool same_bits(Quat a, Quat b) { return std::memcmp(&a, &b, sizeof(Quat)) == 0; }

// Rotation vectors of clean^-1 damaged for one joint.
inline std::vector<Vec3> errors_of(const Take& clean, const Take& other, std::size_t joint) {
  std::vector<Vec3> errors;
  for (std::size_t f = 0; f < clean.frame_count(); ++f) {
    errors.push_back(log(conjugate(clean.rotation(f, joint)) * other.rotation(f, joint)));
  }
  return errors;
}

// A figure in the CMU style of names: pelvis, two legs, spine, head, two arms with hands. Y up, 170
// units tall.
inline Skeleton humanoid_skeleton() {
  Skeleton s;
  const auto root = make_channels(true, parse_rotation_order("ZXY"));
  const auto turns = make_channels(false, parse_rotation_order("ZYX"));
  const auto add = [&](const char* name, const char* parent, Vec3 offset) {
    s.add_joint(name, s.find(parent), offset, s.joint_count() == 0 ? root : turns);
  };
  add("Hips", "", {0, 90, 0});
  for (const char* side : {"Left", "Right"}) {
    const std::string p = side;
    const double x = p == "Left" ? 10 : -10;
    add((p + "UpLeg").c_str(), "Hips", {x, 0, 0});
    add((p + "Leg").c_str(), (p + "UpLeg").c_str(), {0, -40, 0});
    add((p + "Foot").c_str(), (p + "Leg").c_str(), {0, -42, 0});
    add((p + "ToeBase").c_str(), (p + "Foot").c_str(), {0, -8, 14});
    s.end_sites.push_back({s.find(p + "ToeBase"), {0, 0, 6}, ""});
  }
  add("Spine", "Hips", {0, 20, 0});
  add("Spine1", "Spine", {0, 25, 0});
  add("Neck", "Spine1", {0, 12, 0});
  add("Neck1", "Neck", {0, 5, 0});
  add("Head", "Neck1", {0, 6, 0});
  s.end_sites.push_back({s.find("Head"), {0, 12, 0}, ""});
  for (const char* side : {"Left", "Right"}) {
    const std::string p = side;
    const double d = p == "Left" ? 1 : -1;
    add((p + "Shoulder").c_str(), "Spine1", {4 * d, 8, 0});
    add((p + "Arm").c_str(), (p + "Shoulder").c_str(), {14 * d, 0, 0});
    add((p + "ForeArm").c_str(), (p + "Arm").c_str(), {28 * d, 0, 0});
    add((p + "Hand").c_str(), (p + "ForeArm").c_str(), {26 * d, 0, 0});
    add((p + "HandIndex1").c_str(), (p + "Hand").c_str(), {9 * d, 0, 0});
    add((p + "HandThumb1").c_str(), (p + "Hand").c_str(), {3 * d, 0, 4});
    s.end_sites.push_back({s.find(p + "HandIndex1"), {5 * d, 0, 0}, ""});
  }
  return s;
}

inline Take moving_humanoid(std::size_t frames, double frame_rate_hz = 120) {
  Take clip = resting_clip(humanoid_skeleton(), frames, frame_rate_hz);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / frame_rate_hz;
    clip.root_position(f) = {2 * t, 90 + std::sin(6 * t), 100 * t};
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const double k = 1 + 0.1 * static_cast<double>(j);
      clip.rotation(f, j) = exp(
          {0.4 * std::sin(k * 4 * t + 1), 0.2 * std::cos(k * 3 * t), 0.3 * std::sin(k * 2 * t)});
    }
  }
  return clip;
}

}  // namespace kinemend::test
