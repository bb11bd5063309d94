// Smooths tracks by their likeliest models, under white noise and under noise that is correlated
// from frame to frame. Maps tracks so that their white noise has the same variance in all
// directions, and back.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "methods/auto/noise_spectrum.hpp"
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

/// Linear map that gives a track's white noise the same variance in all directions, its mean square
/// over the axes unchanged.
struct Whitening {
  bool is_identity = true;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity();
};

/// The whitening of each track, from its noise covariance: axes of Tyler's scatter of the fifth
/// differences, and the deviation along each by `noise_along`. Identity if the deviations do not
/// differ significantly, the noise is small, or the track is too short. `missing` samples are left
/// out.
std::vector<Whitening> estimate_whitening(const VectorTracks& tracks, const SampleMarks& missing,
                                          double frame_rate_hz, const NoiseTuning& tuning = {});

/// Maps the tracks in place.
void whiten(VectorTracks& tracks, std::span<const Whitening> whitenings);
void undo_whitening(VectorTracks& tracks, std::span<const Whitening> whitenings);
/// The same for one track.
void undo_whitening(std::span<Vec3> track, const Whitening& whitening);

}  // namespace kinemend
