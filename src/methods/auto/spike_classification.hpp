// Decides which candidates are spikes and which are fast motion.
#pragma once

#include <cstddef>
#include <vector>

#include "methods/auto/tuning.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

/// Prediction error of each sample: its distance from the leave-one-out prediction.
struct Predictions {
  std::size_t frames;
  std::vector<double> distances;       ///< N x F, degrees
  std::vector<std::size_t> smoothers;  ///< N: the one of `LeaveOneOut` that predicts the track

  Predictions(std::size_t frame_count, std::size_t tracks)
      : frames(frame_count), distances(frame_count * tracks), smoothers(tracks) {}
  double& errors(std::size_t frame, std::size_t track) { return distances[track * frames + frame]; }
  double errors(std::size_t frame, std::size_t track) const {
    return distances[track * frames + frame];
  }
};

/// Candidates, and the data that classify them.
struct SpikeCandidates {
  const VectorTracks& measured;
  const Predictions& predictions;
  const SampleMarks& marks;
  const std::vector<double>& noise;        ///< per track, degrees
  const std::vector<double>& shares;       ///< 0: a quiet track, 1: a noisy one
  const std::vector<std::uint8_t>& dense;  ///< 1: a track of dense outliers
  const std::vector<std::vector<std::size_t>>& nearby;
  double frame_rate_hz;
  const SpikeTuning& tuning;
  const SampleMarks* missing = nullptr;  ///< bridged gaps, left out; nullptr: none

  bool is_missing(std::size_t frame, std::size_t track) const {
    return missing && (*missing)(frame, track) != 0;
  }
};

/// Classifies candidates as spikes or motion. On a noisy track a spike exceeds the errors about it
/// and does not continue the motion on either side. On a quiet track it exceeds them by more, and
/// no nearby joint has a large error in the same frame; if a quiet take holds only few of these,
/// only those that exceed the speed of any joint and last up to two frames remain. Rejected as fast
/// motion are clusters larger than chance explains and, below 100 Hz, recurrent candidates of one
/// track.
SampleMarks classify_spikes(const SpikeCandidates& candidates);

}  // namespace kinemend
