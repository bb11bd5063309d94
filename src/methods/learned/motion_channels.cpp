// Removes spikes from tracks, converts them to channels, and assembles the cleaned tracks.
#include "methods/learned/motion_channels.hpp"

#include <utility>

#include "cleaner/pieces.hpp"
#include "methods/auto/auto_scale.hpp"
#include "methods/auto/neighbours.hpp"
#include "methods/auto/spikes.hpp"
#include "methods/auto/track_vectors.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

namespace {

void put(MotionTake& take, std::size_t frame, std::size_t n, Vec3 vector) {
  float* const to = take.values.data() + frame * take.channels + 3 * n;
  to[0] = static_cast<float>(vector.x);
  to[1] = static_cast<float>(vector.y);
  to[2] = static_cast<float>(vector.z);
}

// Reads the tracks of one space and removes their spikes.
void read_together(const TakeView& take, const std::vector<std::size_t>& own,
                   MotionTracks& tracks) {
  if (own.empty()) return;
  const std::size_t frames = take.frames, count = own.size();
  VectorTracks vectors(frames, count);
  SampleMarks suspects(frames, count), gaps(frames, count);
  std::vector<std::size_t> numbers;
  numbers.reserve(count);
  for (const std::size_t n : own) numbers.push_back(tracks.numbers[n]);
  for_each_parallel(count, frames * count, [&](std::size_t i) {
    TrackVectors curve = vectors_of(take, numbers[i]);
    for (std::size_t f = 0; f < frames; ++f) {
      vectors.set(f, i, curve.vectors[f]);
      if (!curve.suspects.empty()) suspects(f, i) = curve.suspects[f];
      gaps(f, i) = take.tracks[numbers[i]].is_observed(f) ? 0 : 1;
    }
    tracks.charts[own[i]] = std::move(curve.chart);
  });
  const DetectedSpikes spikes =
      find_spikes(vectors, suspects, tracks_nearby(take, numbers), take.frame_rate_hz, &gaps);
  for (std::size_t i = 0; i < count; ++i) {
    // Relative positions make single precision sufficient far from the world's origin.
    const bool turns = tracks.charts[own[i]].has_value();
    const Vec3 origin = turns ? Vec3{} : vectors.at(0, i);
    tracks.origins[own[i]] = origin;
    for (std::size_t f = 0; f < frames; ++f) {
      put(tracks.take, f, own[i], vectors.at(f, i) - origin);
      const bool is_spike = spikes.marked(f, i) != 0;
      tracks.is_spike[f * tracks.numbers.size() + own[i]] = is_spike ? 1 : 0;
      if (!is_spike && gaps(f, i) == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis)
        tracks.take.missing[f * tracks.take.channels + 3 * own[i] + axis] = 1;
    }
  }
}

}  // namespace

MotionTracks motion_tracks_of(const TakeView& take, std::vector<std::size_t> numbers) {
  MotionTracks tracks;
  tracks.numbers = std::move(numbers);
  const std::size_t count = tracks.numbers.size();
  tracks.charts.resize(count);
  tracks.origins.resize(count);
  tracks.is_spike.resize(take.frames * count);
  tracks.degrees_per_unit = degrees_per_unit(take, Space::position);
  tracks.take.frames = take.frames;
  tracks.take.channels = 3 * count;
  tracks.take.frame_rate_hz = take.frame_rate_hz;
  tracks.take.values.resize(take.frames * 3 * count);
  tracks.take.missing.resize(tracks.take.values.size());
  tracks.take.slots.assign(3 * count, -1);
  std::vector<std::size_t> turning, moving;
  for (std::size_t n = 0; n < count; ++n) {
    const bool turns = take.tracks[tracks.numbers[n]].space == Space::rotation;
    (turns ? turning : moving).push_back(n);
    tracks.take.is_position.insert(tracks.take.is_position.end(), 3, turns ? 0 : 1);
  }
  read_together(take, turning, tracks);
  read_together(take, moving, tracks);
  return tracks;
}

std::vector<float> values_in(const MotionTracks& tracks, const TakeView& other) {
  MotionTake take = tracks.take;
  const double same_unit = tracks.degrees_per_unit / degrees_per_unit(other, Space::position);
  for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
    const std::size_t number = tracks.numbers[n];
    if (const auto& chart = tracks.charts[n]) {
      const std::vector<Quat> rotations = rotation_piece(other, number).samples;
      for (std::size_t f = 0; f < take.frames; ++f)
        put(take, f, n, degrees_per_radian * chart->vector_of(f, rotations[f]));
      continue;
    }
    const std::vector<Vec3> positions = vectors_of(other, number).vectors;
    for (std::size_t f = 0; f < take.frames; ++f)
      put(take, f, n, same_unit * positions[f] - tracks.origins[n]);
  }
  return std::move(take.values);
}

CleanedTrack cleaned_track(const MotionTracks& tracks, const TakeView& take, std::size_t n,
                           std::span<const float> values) {
  std::vector<Vec3> vectors(take.frames);
  std::vector<std::uint8_t> spikes(take.frames);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const float* const from = values.data() + f * tracks.take.channels + 3 * n;
    vectors[f] = tracks.origins[n] + Vec3{from[0], from[1], from[2]};
    spikes[f] = tracks.is_spike[f * tracks.numbers.size() + n];
  }
  const auto& chart = tracks.charts[n];
  return track_of(take, tracks.numbers[n], vectors, spikes, true, chart ? &*chart : nullptr);
}

}  // namespace kinemend
