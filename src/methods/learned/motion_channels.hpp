// Converts tracks of any take to channels of the learned cleaner and back: rotations as vectors
// about a smoothed reference, positions in body heights, both in degrees.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "methods/learned/motion_steps.hpp"
#include "motion/rotation_chart.hpp"

namespace kinemend {

struct MotionTracks {
  std::vector<std::size_t> numbers;  ///< of the take's tracks; channels 3 n to 3 n + 2 are the n-th
  std::vector<std::optional<RotationChart>> charts;  ///< of tracks that turn
  std::vector<std::uint8_t> is_spike;                ///< F x tracks
  double degrees_per_unit = 0;                       ///< of positions
  std::vector<Vec3> origins;                         ///< of each track, subtracted from it
  MotionTake take;                                   ///< without channels of a known body
};

/// Spikes are bridged, and marked as missing.
MotionTracks motion_tracks_of(const TakeView& take, std::vector<std::size_t> numbers);
/// Samples of another take for the same tracks in the same charts and units: F x C.
std::vector<float> values_in(const MotionTracks& tracks, const TakeView& other);
/// The n-th track from `values` (F x C). Unseen marker samples are unchanged.
CleanedTrack cleaned_track(const MotionTracks& tracks, const TakeView& take, std::size_t n,
                           std::span<const float> values);

}  // namespace kinemend
