// Takes for the benchmarks of learned methods.
#pragma once

#include <cstdint>

#include "kinemend/extend/random.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::bench {

inline Take walk(std::uint64_t seed, double rate_hz, double duration_s) {
  SynthOptions options{.motion = "walk", .duration_s = duration_s, .frame_rate_hz = rate_hz};
  options.seed = seed;
  return synthesize(options);
}

// Adds 3 degrees of noise, and outliers to a share of the samples.
inline Take noisy_walk(double rate_hz, double duration_s, double outlier_share) {
  Take clip = walk(3, rate_hz, duration_s);
  Random random(4);
  apply_damage(clip, "gaussian", {{"std_deg", 3.0}}, random);
  if (outlier_share > 0) apply_damage(clip, "outliers", {{"share", outlier_share}}, random);
  return clip;
}

}  // namespace kinemend::bench
