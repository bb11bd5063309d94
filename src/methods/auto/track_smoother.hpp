// Smooths tracks under white noise, each by its likeliest strength.
#pragma once

#include <span>

#include "base/progress.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

/// Smooths tracks in place. Each track is rotated to the principal axes of its fast motion; each
/// axis gets the order and strength of the Whittaker smoother of largest marginal likelihood under
/// `noise` (degrees), then strengths that follow the motion in time; the result is blended with the
/// input by `shares` (0: the track is not changed). `missing` samples have no weight. Takes under 4
/// frames are not changed. `progress`, if any, advances to 0.75.
void smooth_tracks(VectorTracks& tracks, const SampleMarks& missing, std::span<const double> noise,
                   std::span<const double> shares, double frame_rate_hz,
                   ShareProgress* progress = nullptr, const SmoothingTuning& tuning = {});

}  // namespace kinemend
