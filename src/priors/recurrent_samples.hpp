#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/random.hpp"
#include "priors/recurrent_forms.hpp"
#include "priors/recurrent_input.hpp"
#include "priors/training_sequences.hpp"

// Training samples of the method `recurrent`: stretches of clean takes, damaged, and what `auto`
// makes of them.
namespace kinemend {

struct RecurrentSample {
  RecurrentTake take;
  std::vector<float> truth;  ///< F x D
};

RecurrentSample in_form(const RecurrentSample& sample, RecurrentForm form,
                        const BodyMirror& mirror);

/// The sample of another body: each channel moved by a constant (normal, `offset_deg`), and all
/// scaled by one factor of up to `most_scale` or its inverse.
RecurrentSample of_another_body(RecurrentSample sample, double offset_deg, double most_scale,
                                Random random);

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
