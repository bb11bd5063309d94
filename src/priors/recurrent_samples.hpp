#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/body.hpp"
#include "kinemend/random.hpp"
#include "priors/recurrent_input.hpp"
#include "priors/training_sequences.hpp"

// Training samples of the method `recurrent`: stretches of clean takes, damaged, and what `auto`
// makes of them.
namespace kinemend {

struct RecurrentSample {
  RecurrentTake take;
  std::vector<float> truth;  ///< F x D
};

/// Of each track which one it is in a mirror (by Left and Right, or L and R, in the names; itself
/// where there is none); the place is its own.
std::vector<std::size_t> mirrored_tracks(const BodyLayout& layout);

/// The sample in a mirror: exact where the references of the layout are symmetrical. In time: the
/// take run backwards.
RecurrentSample mirrored(const RecurrentSample& sample, const BodyLayout& layout);
RecurrentSample reversed(const RecurrentSample& sample);

/// Mixed damage of a stretch of up to `frames` frames of a sequence, which is drawn in proportion
/// to its length and weight; its speed is changed by up to a third. A fifth are clean. The same
/// `random` gives the same sample.
RecurrentSample random_recurrent_sample(const TrainingSequences& sequences, std::size_t frames,
                                        Random random);

/// A damage as `random_recurrent_sample` draws them, of poses at hand.
RecurrentSample recurrent_sample(const BodyLayout& layout, double rate_hz, const PoseMatrix& truth,
                                 Random random);

/// Of a take that is damaged already. `observed`: F x N tracks, with the place one more; empty:
/// all.
RecurrentSample recurrent_sample_of(const BodyLayout& layout, double rate_hz,
                                    const PoseMatrix& truth, const PoseMatrix& poses,
                                    const std::vector<std::uint8_t>& observed);

/// The means and deviations that the features are measured by.
RecurrentStatistics recurrent_statistics(const TrainingSequences& sequences);

}  // namespace kinemend
