// Converts pieces of tracks to one array per component, the input of the vectorised filters.
#pragma once

#include <vector>

#include "cleaner/pieces.hpp"
#include "cleaner/rotation_track.hpp"

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

/// 1 for an observed sample, 0 for any other, followed by `lane_room` zeros. Empty if all were
/// observed.
inline std::vector<double> lane_weights(const std::vector<std::uint8_t>& observed) {
  std::vector<double> weights(observed.begin(), observed.end());
  if (!weights.empty()) weights.resize(weights.size() + lane_room);
  return weights;
}
template <class Sample>
std::vector<double> lane_weights(const Piece<Sample>& piece) {
  return lane_weights(piece.observed);
}

/// Runs `filter(track)` on the samples of a piece. Unobserved rotations are interpolated between
/// the filtered ones.
template <class Sample, class Filter>
void filter_lanes(Piece<Sample>& piece, const Filter& filter) {
  auto track = to_lanes(piece.samples);
  filter(track);
  for (std::size_t i = 0; i < piece.samples.size(); ++i) piece.samples[i] = track[i];
  if constexpr (std::is_same_v<Sample, Quat>) bridge_rotations(piece);
}

}  // namespace kinemend
