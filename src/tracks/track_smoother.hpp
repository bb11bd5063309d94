#pragma once

#include <span>

#include "base/progress.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

/// Smooths tracks in place as much as their noise asks. Each track is turned to the principal axes
/// of its own motion; each axis takes the order and strength of the Whittaker smoother that are
/// most likely under `noise` (degrees), then strengths that follow the motion in time; the result
/// is blended in by `shares` (0: the track stays as it is). `missing` samples have no weight. Takes
/// under 4 frames stay as they are. `progress`, where there is one, goes on to three quarters.
void smooth_tracks(VectorTracks& tracks, const SampleMarks& missing, std::span<const double> noise,
                   std::span<const double> shares, double frame_rate_hz,
                   ShareProgress* progress = nullptr);

}  // namespace kinemend
