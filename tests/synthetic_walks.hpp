// Encoded synthetic walks, for tests of trainings.
#pragma once

#include <optional>

#include "kinemend/lab/synth.hpp"
#include "lab/training/training_sequences.hpp"

namespace kinemend {

/// Walks of two bodies, encoded at 120 Hz.
inline TrainingSequences encoded_walks(double duration_s) {
  const TrainingTakes takes{2, [duration_s](std::size_t index) -> std::optional<Take> {
                              SynthOptions options;
                              options.duration_s = duration_s;
                              options.seed = index + 1;
                              return synthesize(options);
                            }};
  return encode_takes(takes, {}, 120);
}

}  // namespace kinemend
