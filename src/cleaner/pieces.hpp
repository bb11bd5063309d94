// Prepares tracks for filters: as pieces without long gaps, of rotations and of positions alike,
// and with one array for each component, padded for vector loads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "base/frame_span.hpp"
#include "base/parallel.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// A stretch of a track with its gaps bridged. If gaps are cut, it starts and ends with an observed
/// sample, and none of its gaps is longer than `longest_bridge`; otherwise it is the whole track.
template <class Sample>
struct Piece {
  std::size_t track = 0;
  std::size_t first_frame = 0;
  std::vector<Sample> samples;
  /// One per sample. Empty: all are observed, or are bridges treated as measurements, as in
  /// positions of joints.
  std::vector<std::uint8_t> observed;
  std::vector<Action> actions;  ///< set by a filter that classifies samples; else empty
};

/// The longest gap, in frames, that is bridged when gaps are cut: 0.25 s.
std::size_t longest_bridge(double frame_rate_hz);
/// Frames on either side of such a gap that its bridge uses: 0.05 s, at least 3.
std::size_t bridge_support(double frame_rate_hz);

/// The samples from `first` to before `end` of a piece.
template <class Sample>
Piece<Sample> stretch(const Piece<Sample>& piece, std::size_t first, std::size_t end) {
  const auto cut = [&](const auto& values) {
    const std::span all(values);
    const auto part = all.empty() ? all : all.subspan(first, end - first);
    return std::vector(part.begin(), part.end());
  };
  return {piece.track, piece.first_frame + first, cut(piece.samples), cut(piece.observed),
          cut(piece.actions)};
}

/// The whole of a track of rotations, with geodesics in its gaps.
Piece<Quat> rotation_piece(const TakeView& take, std::size_t track);
/// The pieces of a track of positions, in the order of their frames. Bridges in positions of joints
/// are straight; those of markers are cubics that leave and meet the observed samples at their own
/// velocity (by least squares).
std::vector<Piece<Vec3>> position_pieces(const TakeView& take, std::size_t track);
/// Replaces each unobserved sample by the geodesic between its observed neighbours (at the ends by
/// the nearest one).
void bridge_rotations(Piece<Quat>& piece);

/// A marker's track in one piece, for methods that use all markers of a frame: in long gaps the
/// movement at either end decays within about 0.1 s. Empty if nothing was observed.
std::vector<Vec3> whole_positions(const TakeView& take, std::size_t track);

/// The observed samples of a track.
std::vector<Quat> observed_rotations(const TakeView& take, std::size_t track);
std::vector<Vec3> observed_positions(const TakeView& take, std::size_t track);

/// A cleaned track from its pieces: for markers the observed samples alone, while unobserved ones
/// stay unchanged; for rotations all samples, those in gaps marked as filled.
CleanedTrack assemble(Piece<Quat> piece);
CleanedTrack assemble(const TakeView& take, std::size_t track, std::span<Piece<Vec3>> pieces);

/// The sample of the position track `track` in a frame of this take.
Vec3& position_in(const TakeView& take, std::size_t track, Frame& frame);

/// Runs `filter(piece)`, for pieces of `Quat` and of `Vec3`, on each changeable track, in parallel,
/// and passes the tracks to `sink`.
template <class Filter>
void filter_pieces(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& tell, const Filter& filter) {
  const std::vector<std::size_t> tracks = changeable_tracks(take);
  ShareProgress progress(tell);
  progress.begin_part(1, tracks.size());
  for_each_parallel(tracks.size(), tracks.size() * take.frames, [&](std::size_t i) {
    const std::size_t track = tracks[i];
    if (take.tracks[track].space == Space::rotation) {
      Piece<Quat> piece = rotation_piece(take, track);
      filter(piece);
      sink(track, assemble(std::move(piece)));
    } else {
      std::vector<Piece<Vec3>> pieces = position_pieces(take, track);
      for (Piece<Vec3>& piece : pieces) filter(piece);
      sink(track, assemble(take, track, pieces));
    }
    progress.step();
  });
}

/// Padding after the last frame of a track, so that full vectors can be loaded and stored there.
/// The number of doubles in the widest vectors, by definition.
inline constexpr std::size_t lane_room = 8;

/// Vectors over time, one array per component. The arrays are `lane_room` longer than `frames`.
struct VectorTrack {
  std::size_t frames = 0;
  std::vector<double> x, y, z;

  explicit VectorTrack(std::size_t frame_count = 0);
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
};

/// Rotations of one joint over time, one array per component, initially the identity. The arrays
/// are `lane_room` longer than `frames`.
struct RotationTrack {
  std::size_t frames = 0;
  std::vector<double> w, x, y, z;

  explicit RotationTrack(std::size_t frame_count = 0);
  Quat operator[](std::size_t i) const { return {w[i], x[i], y[i], z[i]}; }
  void set(std::size_t i, Quat q) { w[i] = q.w, x[i] = q.x, y[i] = q.y, z[i] = q.z; }
};

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
