// Smooths channels by their measured noise and combines both estimates for each track.
#include "methods/learned/measured_smoothing.hpp"

#include <algorithm>

#include "methods/auto/track_cleaning.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

namespace {

// Smooths tracks of one kind together, as `auto` does.
void smooth_together(const std::vector<std::size_t>& numbers, TrackKind kind, MotionTake& take) {
  const std::size_t count = numbers.size();
  if (count == 0) return;
  VectorTracks tracks(take.frames, count);
  const SampleMarks no_suspects(take.frames, count);
  SampleMarks gaps(take.frames, count);
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t f = 0; f < take.frames; ++f) {
      const float* const v = take.values.data() + f * take.channels + 3 * numbers[n];
      tracks.set(f, n, {v[0], v[1], v[2]});
      gaps(f, n) = take.is_missing(f, 3 * numbers[n]) ? 1 : 0;
    }
  }
  const CleanedTracks verdicts =
      clean_tracks(tracks, no_suspects, gaps, std::vector<std::vector<std::size_t>>(count),
                   take.frame_rate_hz, {1, false, kind, {}});
  for (std::size_t n = 0; n < count; ++n) {
    if (verdicts.shares[n] == 0) continue;
    for (std::size_t f = 0; f < take.frames; ++f) {
      const Vec3 v = tracks.at(f, n);
      float* const to = take.measured.data() + f * take.channels + 3 * numbers[n];
      to[0] = static_cast<float>(v.x);
      to[1] = static_cast<float>(v.y);
      to[2] = static_cast<float>(v.z);
    }
  }
}

// Sums over the observed samples: squares of what an estimate removes, and of the quick part.
struct TakenOut {
  double all = 0, quick = 0;
};

TakenOut taken_out(const MotionTake& take, const std::vector<float>& estimate, std::size_t track) {
  const std::size_t later = frames_of_quick_noise(take.frame_rate_hz);
  TakenOut sums;
  const auto change = [&](std::size_t i) {
    return static_cast<double>(estimate[i] - take.values[i]);
  };
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
      if (take.is_missing(f, c)) continue;
      const std::size_t i = f * take.channels + c;
      sums.all += change(i) * change(i);
      if (f < later || take.is_missing(f - later, c)) continue;
      const double difference = change(i) - change(i - later * take.channels);
      sums.quick += 0.5 * difference * difference;
    }
  }
  return sums;
}

}  // namespace

void join_measured(const MotionTake& take, MotionResult& result) {
  if (take.measured.empty()) return;
  for (std::size_t track = 0; track < take.channels / 3; ++track) {
    const TakenOut by_measure = taken_out(take, take.measured, track);
    if (by_measure.all == 0) continue;
    const double by_network = taken_out(take, result.values, track).all;
    const double quick = std::min(1.0, by_measure.quick / by_measure.all);
    const auto share =
        static_cast<float>(quick * quick * by_measure.all / (by_measure.all + by_network));
    for (std::size_t f = 0; f < take.frames; ++f) {
      for (std::size_t i = f * take.channels + 3 * track; i < f * take.channels + 3 * track + 3;
           ++i)
        result.values[i] += share * (take.measured[i] - result.values[i]);
    }
  }
}

void add_measured_smoothing(MotionTake& take) {
  take.measured = take.values;
  if (take.frames < fewest_clean_frames) return;
  std::vector<std::size_t> turning, moving;
  for (std::size_t n = 0; n < take.channels / 3; ++n)
    (take.is_position[3 * n] != 0 ? moving : turning).push_back(n);
  smooth_together(turning, TrackKind::rotations, take);
  smooth_together(moving, TrackKind::positions, take);
}

}  // namespace kinemend
