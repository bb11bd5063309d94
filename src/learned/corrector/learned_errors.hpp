// Measures how wrong a take was, as far as the learned cleaner can say.
#pragma once

#include <cstddef>
#include <span>

#include "kinemend/cleaner.hpp"
#include "learned/corrector/motion_filter.hpp"

namespace kinemend {

/// Mean squares per axis of a track, degrees squared.
struct TrackError {
  double removed = 0, left = 0;
  double quick = 0;        ///< of what was removed, what is not the same a little later
  double correlation = 0;  ///< of what was removed, from frame to frame

  double all() const { return removed + left; }
};

/// Of channels 3 `track` to 3 `track` + 2.
TrackError track_error(const MotionTake& take, const MotionResult& result, std::size_t track);

/// Whether a change is more than a tenth of what may be wrong anyway. A smaller one is not made: a
/// clean track keeps its samples.
bool is_worth_a_change(const TrackError& error);

/// What was taken out of the middle one of the tracks that are worth a change, degrees per axis.
ColouredNoise removed_noise(std::span<const TrackError> errors);

/// Slow noise of the middle one of those tracks that are worth a change, degrees per axis; 0 where
/// errors are small or show from frame to frame.
double slow_noise(std::span<const TrackError> errors);

}  // namespace kinemend
