#pragma once

#include <cstddef>
#include <functional>

#include "kinemend/body.hpp"
#include "kinemend/pose_matrix.hpp"
#include "kinemend/train.hpp"

// What every fit of a model starts from: takes as stretches of channels at the model's rate.
namespace kinemend {

/// The layout of a set of takes; each is asked for once. Errors: `ErrorKind::usage` as of
/// `BodyLayoutBuilder`, and for no takes.
BodyLayout learn_layout(const TrainingTakes& takes, const TrainSettings& settings,
                        double trend_s = BodyLayout{}.trend_s);

/// Motion without gaps.
struct TrainingSequence {
  PoseMatrix poses;      ///< F x D degrees, at the model's rate
  double weight = 1;     ///< of each of its frames
  std::size_t take = 0;  ///< where it comes from
};

/// Calls `use` with every stretch of every take in which no part is missing, of at least
/// `least_frames` frames; each take is asked for once. Of a take whose rate is a multiple of
/// `rate_hz` every phase is a sequence, and their weights add up to 1; any other is resampled.
/// Returns the seconds of motion that were used.
double for_each_sequence(const TrainingTakes& takes, const BodyLayout& layout, double rate_hz,
                         std::size_t least_frames, const TrainSettings& settings,
                         const std::function<void(const TrainingSequence&)>& use);

/// A sequence as of one of the halves of all takes, 0 or 1, so that what is learned of one can be
/// tried on the other: every other take; of `takes` = 1 the halves of each sequence, or 0 where
/// these would be shorter than `least_frames`.
void for_each_half(const TrainingSequence& sequence, std::size_t takes, std::size_t least_frames,
                   const std::function<void(std::size_t half, const PoseMatrix& poses)>& use);

}  // namespace kinemend
