// Tracks of any take as channels of the learned cleaner, and back: rotations as vectors about a
// smoothed reference, positions in body heights, both in degrees.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "learned/corrector/motion_steps.hpp"
#include "rotation/rotation_chart.hpp"

namespace kinemend {

struct MotionTracks {
  std::vector<std::size_t> numbers;  ///< of the take's tracks; channels 3 n to 3 n + 2 are the n-th
  std::vector<std::optional<RotationChart>> charts;  ///< of those that turn
  std::vector<std::uint8_t> is_spike;                ///< F x tracks
  double degrees_per_unit = 0;                       ///< of positions
  std::vector<Vec3> origins;                         ///< of each track: what is taken off it
  MotionTake take;                                   ///< no channel of it is known
};

/// Spikes are bridged, and missing to the network.
MotionTracks motion_tracks_of(const TakeView& take, std::vector<std::size_t> numbers);
/// Another take's samples of the same tracks in the same charts and units: F x C.
std::vector<float> values_in(const MotionTracks& tracks, const TakeView& other);
/// What `values` (F x C) say of the n-th track. Samples that are not the network's stay: markers
/// that were not seen.
CleanedTrack cleaned_track(const MotionTracks& tracks, const TakeView& take, std::size_t n,
                           std::span<const float> values);

}  // namespace kinemend
