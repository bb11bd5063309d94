// Maps tracks so that their noise has the same variance in all directions, and back.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

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
