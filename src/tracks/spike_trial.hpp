#pragma once

#include <cstddef>
#include <vector>

#include "tracks/vector_tracks.hpp"

namespace kinemend {

inline constexpr double least_noise =
    0.25;  // degrees: what a spike is measured against on a noiseless track
inline constexpr double least_deviation =
    6;  // degrees: what is nearer to its prediction is no spike

/// How far each sample is from where the others of its track put it.
struct Predictions {
  std::size_t frames;
  std::vector<double> distances;       ///< N x F, degrees
  std::vector<std::size_t> smoothers;  ///< N: which one of `LeaveOneOut` predicts the track

  Predictions(std::size_t frame_count, std::size_t tracks)
      : frames(frame_count), distances(frame_count * tracks), smoothers(tracks) {}
  double& errors(std::size_t frame, std::size_t track) { return distances[track * frames + frame]; }
  double errors(std::size_t frame, std::size_t track) const {
    return distances[track * frames + frame];
  }
};

/// What is known of the accused samples.
struct SpikeTrial {
  const VectorTracks& measured;
  const Predictions& predictions;
  const SampleMarks& accused;
  const std::vector<double>& noise;   ///< of each track, degrees
  const std::vector<double>& shares;  ///< 0: a quiet track, 1: a noisy one
  const std::vector<std::vector<std::size_t>>& nearby;
  double frame_rate_hz;
  const SampleMarks* missing = nullptr;  ///< gaps already bridged: no witnesses; nullptr: none

  bool is_missing(std::size_t frame, std::size_t track) const {
    return missing && (*missing)(frame, track) != 0;
  }
};

/// Which of the accused are spikes. On a noisy track: whoever stands clear of the errors about it
/// and does not go on where one of its sides is heading. On a quiet track it stands clearer still,
/// and no joint nearby moves with it; and where a quiet take holds only a few of those, they are
/// what no body can do: leaps faster than any joint turns, there and back within two frames. More
/// verdicts in a cluster than chance puts together are acquitted: they are fast motion; so are,
/// below 100 Hz, more on one track than chance puts there.
SampleMarks judge_spikes(const SpikeTrial& trial);

}  // namespace kinemend
