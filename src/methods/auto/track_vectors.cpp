// Builds the vectors of a track by its chart or its scale, and assembles the cleaned track from
// them.
#include "methods/auto/track_vectors.hpp"

#include <utility>

#include "cleaner/pieces.hpp"
#include "methods/auto/auto_scale.hpp"
#include "methods/auto/dense_outliers.hpp"
#include "methods/auto/smooth_chart.hpp"
#include "methods/auto/spikes.hpp"

namespace kinemend {

namespace {

// Dense outliers bend a reference most at the ends of the take, where its mean has few samples; the
// reference is then computed without them.
RotationChart chart_of(const std::vector<Quat>& rotations, double frame_rate_hz,
                       std::vector<std::uint8_t>* gross = nullptr) {
  std::vector<Quat> track = rotations;
  std::vector<std::uint8_t> marks = replace_gross_spikes(track);
  if (gross) *gross = std::move(marks);
  RotationChart chart = smooth_chart(track, frame_rate_hz);
  std::vector<Vec3> vectors;
  vectors.reserve(rotations.size());
  for (std::size_t t = 0; t < rotations.size(); ++t)
    vectors.push_back(degrees_per_radian * chart.vector_of(t, rotations[t]));
  const std::vector<std::uint8_t> dense = dense_outliers(vectors, {}, frame_rate_hz);
  if (dense.empty()) return chart;
  fill_marked(vectors, dense);
  for (std::size_t t = 0; t < track.size(); ++t)
    track[t] = dense[t] != 0 ? chart.rotation_of(t, radians_per_degree * vectors[t]) : rotations[t];
  return smooth_chart(track, frame_rate_hz);
}

// A bridge follows the sample at its start even if that is a spike, so the samples beside gaps are
// the first suspects.
std::vector<std::uint8_t> beside_gaps(const Track& track, std::size_t frames) {
  std::vector<std::uint8_t> marks(frames);
  for (std::size_t t = 1; t < frames; ++t) {
    const bool before = track.is_observed(t - 1), now = track.is_observed(t);
    if (before != now) marks[now ? t : t - 1] = 1;
  }
  return marks;
}

}  // namespace

TrackVectors vectors_of(const TakeView& take, std::size_t number) {
  TrackVectors curve;
  const Track& track = take.tracks[number];
  if (track.space == Space::rotation) {
    const std::vector<Quat> rotations = rotation_piece(take, number).samples;
    curve.chart = chart_of(rotations, take.frame_rate_hz, &curve.suspects);
    for (std::size_t t = 0; t < take.frames; ++t)
      curve.vectors.push_back(degrees_per_radian * curve.chart->vector_of(t, rotations[t]));
    return curve;
  }
  const double degrees = degrees_per_unit(take);
  if (take.markers) curve.suspects = beside_gaps(track, take.frames);
  curve.vectors = take.markers ? whole_positions(take, number)
                               : std::move(position_pieces(take, number).front().samples);
  for (Vec3& vector : curve.vectors) vector = degrees * vector;
  return curve;
}

CleanedTrack track_of(const TakeView& take, std::size_t number, std::span<const Vec3> vectors,
                      std::span<const std::uint8_t> spikes, bool smoothed,
                      const RotationChart* chart) {
  const Track& track = take.tracks[number];
  const auto is_new = [&](std::size_t t) { return smoothed || spikes[t] != 0; };
  if (track.space == Space::rotation) {
    Piece<Quat> piece = rotation_piece(take, number);
    piece.actions.assign(take.frames, Action::kept);
    RotationChart made;
    if (!chart) {
      made = chart_of(piece.samples, take.frame_rate_hz);
      chart = &made;
    }
    for (std::size_t t = 0; t < take.frames; ++t) {
      if (is_new(t)) piece.samples[t] = chart->rotation_of(t, radians_per_degree * vectors[t]);
      if (spikes[t] != 0) piece.actions[t] = Action::despiked;
    }
    return assemble(std::move(piece));
  }
  std::vector<Piece<Vec3>> pieces = position_pieces(take, number);
  for (Piece<Vec3>& piece : pieces) {
    piece.actions.assign(piece.samples.size(), Action::kept);
    for (std::size_t i = 0; i < piece.samples.size(); ++i) {
      const std::size_t t = piece.first_frame + i;
      if (is_new(t)) piece.samples[i] = (1 / degrees_per_unit(take)) * vectors[t];
      if (spikes[t] != 0) piece.actions[i] = Action::despiked;
    }
  }
  return assemble(take, number, pieces);
}

}  // namespace kinemend
