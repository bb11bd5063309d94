// Makes a take from a motion: checks the options and samples every frame.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/synth.hpp"
#include "lab/synthesis/motions.hpp"
#include "lab/synthesis/spin.hpp"

namespace kinemend {

namespace {

constexpr std::array<std::string_view, 11> motion_names{
    "walk", "run", "jump", "turn", "wave", "stroll", "clap", "punch", "landing", "still", "spin"};

void check_range(const char* name, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return;
  throw Error(ErrorKind::usage,
              fmt::format("{}: {} is outside {} to {} {}", name, value, low, high, unit));
}

void check(const SynthOptions& options) {
  check_range("duration_s", options.duration_s, 0.1, 600, "s");
  check_range("frame_rate_hz", options.frame_rate_hz, 1, 1000, "Hz");
  for (std::string_view name : motion_names) {
    if (name == options.motion) return;
  }
  std::string known;
  for (std::string_view name : motion_names)
    known += (known.empty() ? "" : ", ") + std::string(name);
  throw Error(ErrorKind::usage,
              fmt::format("unknown motion {}; there are {}", options.motion, known));
}

void append(Take& clip, const synth::BodyPose& pose) {
  clip.positions.push_back(pose.root);
  clip.rotations.insert(clip.rotations.end(), pose.rotations.begin(), pose.rotations.end());
}

Take humanoid(const SynthOptions& options, std::size_t frames) {
  Random random(options.seed);
  const synth::Body body(172 + 6 * std::clamp(random.normal(), -2.0, 2.0));
  Take clip;
  clip.skeleton = body.skeleton;
  if (options.t_pose_first) append(clip, {{0, body.straight_height(), 0}, {}});
  const synth::Motion motion =
      synth::make_motion(options.motion, body, options.duration_s, random.fork(1));
  for (std::size_t f = 0; f < frames; ++f) {
    append(clip, synth::assemble(body, motion(static_cast<double>(f) / options.frame_rate_hz)));
  }
  return clip;
}

}  // namespace

std::span<const std::string_view> synth_motions() { return motion_names; }

Take synthesize(const SynthOptions& options) {
  check(options);
  const auto frames = static_cast<std::size_t>(
      std::max(1.0, std::round(options.duration_s * options.frame_rate_hz)));
  Take clip = options.motion == "spin" ? synth::spin(options, frames) : humanoid(options, frames);
  clip.frame_rate_hz = options.frame_rate_hz;
  clip.source.name = options.motion;
  const std::size_t joints = clip.joint_count();
  for (std::size_t j = 0; j < joints; ++j) {
    align_hemispheres(std::span(clip.rotations).subspan(j), joints);
  }
  return clip;
}

}  // namespace kinemend
