#include "clean/track_cleaning.hpp"

#include <utility>

#include "clean/noise_shape.hpp"
#include "clean/spikes.hpp"
#include "clean/track_smoother.hpp"

namespace kinemend {

CleanedTracks clean_tracks(VectorTracks& tracks, const SampleMarks& suspects,
                           const SampleMarks& always_missing,
                           const std::vector<std::vector<std::size_t>>& nearby,
                           double frame_rate_hz, const AutoOptions& options) {
  const std::vector<NoiseShape> shapes = noise_shapes(tracks, always_missing, frame_rate_hz);
  make_round(tracks, shapes);
  CleanedTracks verdicts{SampleMarks(tracks.frames(), tracks.tracks()), {}, {}};
  if (options.despike) {
    SpikeVerdicts found = find_spikes(tracks, suspects, nearby, frame_rate_hz, &always_missing);
    verdicts.marked = std::move(found.marked);
    verdicts.noise = std::move(found.noise);
  } else {
    verdicts.noise = noise_levels(tracks, always_missing);
  }
  for (double& level : verdicts.noise) level *= options.sensitivity;
  verdicts.shares = cleaning_shares(verdicts.noise, frame_rate_hz);
  const SampleMarks missing = either(verdicts.marked, always_missing);
  // A track that was hardly seen keeps its bridges.
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    std::size_t seen = 0;
    for (std::size_t t = 0; t < tracks.frames(); ++t) seen += missing(t, n) == 0;
    if (seen < 2 * fewest_clean_frames) verdicts.shares[n] = 0;
  }
  smooth_tracks(tracks, missing, verdicts.noise, verdicts.shares, frame_rate_hz);
  undo_round(tracks, shapes);
  return verdicts;
}

}  // namespace kinemend
