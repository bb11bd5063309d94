// The input of every fit of a model: takes as stretches of channels at the model's rate, read and
// encoded once.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "base/files.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/lab/train.hpp"

namespace kinemend {

/// Motion without gaps.
struct TrainingSequence {
  PoseMatrix poses;      ///< F x D degrees, at the model's rate
  double weight = 1;     ///< of each of its frames
  std::size_t take = 0;  ///< index of its take
};

/// The takes of a training in the channels of the body that they share. A take whose rate is a
/// multiple of `rate_hz` gives one sequence per phase, with weights that add up to 1; any other is
/// resampled. Stretches in which a track is missing are left out.
struct TrainingSequences {
  struct Entry {
    std::size_t frames = 0;
    double weight = 1;
    std::size_t take = 0;
  };

  BodyLayout layout;
  double rate_hz = 0;
  std::size_t takes = 0;       ///< as far as `auto` can tell: white noise, and no repeated frames
  std::vector<Entry> entries;  ///< in the order of takes
  Spool values{0};             ///< one record per entry, F x D doubles
};

/// Reads each take once. Memory is bounded by `settings.most_memory` and the largest take. Errors:
/// `ErrorKind::usage` as of `BodyLayoutBuilder` and `match_body`, and for no takes; as of `Spool`.
TrainingSequences encode_takes(const TrainingTakes& takes, const TrainSettings& settings,
                               double rate_hz, double trend_s = BodyLayout{}.trend_s);

/// Frames [first, last) of a sequence, all of it by default. Safe from several threads.
TrainingSequence sequence_at(const TrainingSequences& sequences, std::size_t index,
                             std::size_t first = 0,
                             std::size_t last = std::numeric_limits<std::size_t>::max());

/// Calls `use` with every sequence of at least `least_frames` frames, in order. Returns the seconds
/// of motion that were used.
double for_each_sequence(const TrainingSequences& sequences, std::size_t least_frames,
                         const TrainSettings& settings,
                         const std::function<void(const TrainingSequence&)>& use);

/// Mean, deviation, and root mean square of the changes over `lag` frames of each channel over all
/// sequences; degrees.
struct ChannelMoments {
  std::vector<double> mean, deviation, change;
};
ChannelMoments channel_moments(const TrainingSequences& sequences, std::size_t lag);

/// Passes a sequence on as part of half 0 or 1, for cross-validation: takes alternate; with one
/// take (`takes` = 1) the halves of each sequence, or 0 if these would be shorter than
/// `least_frames`.
void for_each_half(const TrainingSequence& sequence, std::size_t takes, std::size_t least_frames,
                   const std::function<void(std::size_t half, const PoseMatrix& poses)>& use);

}  // namespace kinemend
