// Turns pieces of tracks into one array for each component, as the vectorised filters take them.
#pragma once

#include <vector>

#include "methods/core/pieces.hpp"
#include "methods/filters/rotation_track.hpp"

namespace kinemend {

inline RotationTrack to_lanes(const std::vector<Quat>& samples) {
  RotationTrack track(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) track.set(i, samples[i]);
  return track;
}

inline VectorTrack to_lanes(const std::vector<Vec3>& samples) {
  VectorTrack track(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) track.set(i, samples[i]);
  return track;
}

/// 1 for an observed sample, 0 for any other, with `lane_room` zeros behind. Empty where all were.
inline std::vector<double> lane_weights(const std::vector<std::uint8_t>& observed) {
  std::vector<double> weights(observed.begin(), observed.end());
  if (!weights.empty()) weights.resize(weights.size() + lane_room);
  return weights;
}
template <class Sample>
std::vector<double> lane_weights(const Piece<Sample>& piece) {
  return lane_weights(piece.observed);
}

/// Runs `filter(track)` on the samples of a piece. Rotations that were not observed come out
/// interpolated between the filtered ones.
template <class Sample, class Filter>
void filter_lanes(Piece<Sample>& piece, const Filter& filter) {
  auto track = to_lanes(piece.samples);
  filter(track);
  for (std::size_t i = 0; i < piece.samples.size(); ++i) piece.samples[i] = track[i];
  if constexpr (std::is_same_v<Sample, Quat>) bridge_rotations(piece);
}

}  // namespace kinemend
