// Makes artificial takes of known motion.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "kinemend/take.hpp"

namespace kinemend {

/// A synthetic take of a full humanoid, made from published normative gait data: clean ground truth
/// for tests, benchmarks and the demonstration.
struct SynthOptions {
  std::string motion = "walk";  ///< one of `synth_motions()`
  double duration_s = 6;        ///< 0.1 to 600
  double frame_rate_hz = 120;   ///< 1 to 1000
  std::uint64_t seed = 1;       ///< small differences between performers and strides
  /// Puts a T-pose before the motion (one more frame), as in the CMU files.
  bool t_pose_first = false;
};

/// Returns the names of the motions:
/// - `walk`, `run`: straight ahead
/// - `turn`: in circles; the heading passes 360 degrees within 6 s and continues
/// - `stroll`: walks, turns by 195 degrees, waves on the way back, and repeats this
/// - `jump`: a counter-movement jump on the spot every 2.8 s
/// - `landing`: one jump down from a box of 40 cm (0.3 to 2.6 s)
/// - `wave`
/// - `clap`: palms meet at about 4 m/s and rest on one another for 50 ms
/// - `punch`: straight punches, 6 m/s
/// - `still`: standing, swaying a little
/// - `spin`: not a humanoid but a chain of five joints in ZYX order that repeatedly turn through
///   +-180 degrees of yaw while their pitch swings to +-88 degrees
std::span<const std::string_view> synth_motions();

/// Makes a take. Centimetres, y up, facing +z, x to the left; floor at y = 0; 31 joints in ZXY
/// order, six channels at the root; segment lengths are shares of a body height of 172 +- 6 cm
/// (Drillis and Contini 1966, in Winter's Biomechanics and Motor Control of Human Movement).
///
/// Walking and running follow published mean joint angles by percent of the stride (knee: Schwartz
/// et al. 2008; hip, ankle, pelvis: Kadaba et al. 1990, Perry and Burnfield 2010; arms: Murray et
/// al. 1967; running: Novacheck 1998), held as trigonometric interpolants. The pelvis moves so that
/// the standing foot rests, and the legs absorb the difference: in stance the foot turns about its
/// heel, lies flat, and turns about its ball, and each of these points stays fixed. Everything is a
/// function of continuous time with two continuous derivatives, so a take at any rate or of any
/// duration shows the same motion, and the same options give the same clip. Errors:
/// `ErrorKind::usage` for an unknown motion or a value out of range.
Take synthesize(const SynthOptions& options = {});

}  // namespace kinemend
