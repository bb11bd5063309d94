// Smooths tracks under noise that is correlated from frame to frame.
#pragma once

#include <span>

#include "base/progress.hpp"
#include "methods/auto/noise_spectrum.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

/// Smooths tracks in place under noise that is correlated from frame to frame, as `smooth_tracks`
/// does under white noise: each axis takes the likeliest order and strength of the Whittaker
/// smoother under its noise (`spectrum.deviations` times `scale`), with residuals weighted by the
/// precision of that noise. Strengths then follow the motion in time. Under slow noise (`is_slow`)
/// third differences of the motion are white, and strengths are constant so that they do not follow
/// bursts of noise. The result is blended in by `shares`. `missing` samples have no weight.
void smooth_coloured(VectorTracks& tracks, const SampleMarks& missing,
                     const NoiseSpectrum& spectrum, double scale, std::span<const double> shares,
                     double frame_rate_hz, ShareProgress* progress = nullptr,
                     const ColourTuning& tuning = {});

}  // namespace kinemend
