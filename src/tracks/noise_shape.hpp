#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "tracks/vector_tracks.hpp"

namespace kinemend {

/// How the white noise of a track lies in space, as the map that makes it alike in all directions
/// and keeps its mean square over the axes.
struct NoiseShape {
  bool is_round = true;  ///< alike already: the maps are the identity
  Eigen::Matrix3d to_round = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d from_round = Eigen::Matrix3d::Identity();
};

/// The shape of each track's noise: directions of Tyler's scatter of the fifth differences, and
/// along each of them the noise as `noise_along` measures it. A track is round where its noise
/// does not differ clearly between directions, is small, or cannot be measured. `missing` samples
/// do not count.
std::vector<NoiseShape> noise_shapes(const VectorTracks& tracks, const SampleMarks& missing,
                                     double frame_rate_hz);

/// Maps the tracks that are not round.
void make_round(VectorTracks& tracks, std::span<const NoiseShape> shapes);
void undo_round(VectorTracks& tracks, std::span<const NoiseShape> shapes);

}  // namespace kinemend
