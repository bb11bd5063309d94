#include "clean/auto_markers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantiles.hpp"
#include "clean/clip_tracks.hpp"
#include "clean/whole_markers.hpp"
#include "tracks/track_cleaning.hpp"

namespace kinemend {

namespace {

// A bridge follows the sample it starts at, also where that is a spike: the samples beside gaps are
// the first to be doubted.
SampleMarks beside_gaps(const SampleMarks& missing) {
  SampleMarks marks(missing.frames, missing.tracks);
  for (std::size_t t = 1; t < missing.frames; ++t) {
    for (std::size_t n = 0; n < missing.tracks; ++n) {
      if (missing(t - 1, n) == missing(t, n)) continue;
      marks(missing(t, n) != 0 ? t - 1 : t, n) = 1;
    }
  }
  return marks;
}

}  // namespace

std::vector<std::vector<std::size_t>> rigid_neighbours(const MarkerClip& clip,
                                                       const std::vector<std::size_t>& markers,
                                                       double body_height) {
  constexpr std::size_t most_frames = 50, least_frames = 10, most_neighbours = 4;
  constexpr double farthest = 0.3, largest_spread = 0.02;  // statures
  const std::size_t frames = clip.frame_count(), sampled = std::min(frames, most_frames);
  std::vector<std::vector<std::size_t>> result(markers.size());
  for_each_parallel(markers.size(), markers.size() * markers.size() * sampled, [&](std::size_t n) {
    std::vector<std::pair<double, std::size_t>> near;
    std::vector<double> distances;
    for (std::size_t other = 0; other < markers.size(); ++other) {
      if (other == n) continue;
      distances.clear();
      for (std::size_t i = 0; i < sampled; ++i) {
        const std::size_t f = sampled < 2 ? 0 : i * (frames - 1) / (sampled - 1);
        if (clip.is_observed(f, markers[n]) && clip.is_observed(f, markers[other]))
          distances.push_back(
              norm(clip.position(f, markers[n]) - clip.position(f, markers[other])));
      }
      if (distances.size() < std::min(least_frames, sampled) || distances.empty()) continue;
      const double usual = upper_median_of(distances);
      if (usual > farthest * body_height) continue;
      for (double& distance : distances) distance = std::fabs(distance - usual);
      if (upper_median_of(distances) < largest_spread * body_height)
        near.emplace_back(usual, other);
    }
    std::sort(near.begin(), near.end());
    for (std::size_t i = 0; i < std::min(near.size(), most_neighbours); ++i)
      result[n].push_back(near[i].second);
  });
  return result;
}

MarkerTrace clean_markers_by_evidence(MarkerClip& clip, const MarkerSelection& selection,
                                      const AutoOptions& options) {
  const double degrees_per_unit = degrees_per_height / selection.body_height;
  const std::size_t frames = clip.frame_count();
  MarkerTrace trace;
  if (frames < fewest_clean_frames) return trace;
  const std::vector<WholeMarker> wholes = whole_markers(clip, selection);
  const std::size_t count = wholes.size();
  if (count == 0) return trace;
  std::vector<std::size_t> markers(count);
  VectorTracks tracks(frames, count);
  SampleMarks missing(frames, count);
  for (std::size_t n = 0; n < count; ++n) {
    markers[n] = wholes[n].marker;
    for (std::size_t t = 0; t < frames; ++t) missing(t, n) = !clip.is_observed(t, markers[n]);
    for (std::size_t t = 0; t < frames; ++t)
      tracks.set(t, n, degrees_per_unit * wholes[n].positions[t]);
  }
  const CleanedTracks verdicts = clean_tracks(
      tracks, beside_gaps(missing), missing, rigid_neighbours(clip, markers, selection.body_height),
      clip.frame_rate_hz, {options.sensitivity, options.despike});

  trace.actions.assign(clip.positions.size(), Action::kept);
  trace.noise.assign(clip.marker_count(), 0);
  for (std::size_t n = 0; n < count; ++n) {
    trace.noise[markers[n]] = verdicts.noise[n] / degrees_per_unit;
    for (std::size_t t = 0; t < frames; ++t) {
      const bool spike = verdicts.marked(t, n) != 0;
      if (missing(t, n) != 0 || (verdicts.shares[n] == 0 && !spike)) continue;
      clip.position(t, markers[n]) = (1 / degrees_per_unit) * tracks.at(t, n);
      if (spike) trace.actions[t * clip.marker_count() + markers[n]] = Action::despiked;
    }
  }
  return trace;
}

}  // namespace kinemend
