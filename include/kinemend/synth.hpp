#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "kinemend/clip.hpp"

namespace kinemend {

/// A synthetic take of a full humanoid, made from published normative gait data: clean truth for
/// tests, benchmarks and the demonstration.
struct SynthOptions {
  std::string motion = "walk";  ///< one of `synth_motions()`
  double duration_s = 6;        ///< 0.1 to 600
  double frame_rate_hz = 120;   ///< 1 to 1000
  std::uint64_t seed = 1;       ///< small differences between performers and strides
  bool t_pose_first = false;    ///< puts a T-pose before the motion, as in the CMU files
};

std::span<const std::string_view> synth_motions();
/// Errors: `ErrorKind::usage` for an unknown motion or a value out of range.
Clip synthesize(const SynthOptions& options = {});

}  // namespace kinemend
