// Measures the error of a take as the learned cleaner estimates it.
#pragma once

#include <cstddef>
#include <span>

#include "kinemend/cleaner.hpp"
#include "methods/learned/motion_filter.hpp"

namespace kinemend {

/// Mean squares per axis of a track, degrees squared.
struct TrackError {
  double removed = 0, left = 0;
  double quick = 0;        ///< the part of `removed` that changes within 1/25 s
  double correlation = 0;  ///< of the removed error from frame to frame

  double all() const { return removed + left; }
};

/// The errors of channels 3 `track` to 3 `track` + 2.
TrackError track_error(const MotionTake& take, const MotionResult& result, std::size_t track);

/// Whether a change exceeds a tenth of the remaining error. Smaller changes are not made: a clean
/// track keeps its samples.
bool is_worth_a_change(const TrackError& error);

/// The removed noise of the tracks that are worth a change: the median, degrees per axis.
ColouredNoise removed_noise(std::span<const TrackError> errors);

/// Slow noise of those tracks: the median, degrees per axis; 0 if errors are small or vary from
/// frame to frame.
double slow_noise(std::span<const TrackError> errors);

}  // namespace kinemend
