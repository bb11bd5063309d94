#include "priors/motion/measured_smoothing.hpp"

#include "tracks/track_cleaning.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

namespace {

// Tracks of one kind, as `auto` takes them together.
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

}  // namespace

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
