#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

#include "clean/changes.hpp"
#include "clean/clip_tracks.hpp"
#include "clean/gap_step.hpp"
#include "clean/marker_tracks.hpp"
#include "clean/selection.hpp"
#include "kinemend/clean.hpp"

namespace kinemend {

namespace {

// A marker of the take before and after all steps.
MarkerTrack track_of(const MarkerClip& before, const MarkerClip& after, const MarkerTrace& trace,
                     std::size_t marker) {
  const std::size_t frames = before.frame_count();
  MarkerTrack track;
  track.before.resize(frames);
  track.after.resize(frames);
  track.observed.resize(frames);
  track.observed_after.resize(frames);
  track.stated.resize(trace.actions.empty() ? 0 : frames);
  for (std::size_t f = 0; f < frames; ++f) {
    track.observed[f] = before.is_observed(f, marker);
    track.observed_after[f] = after.is_observed(f, marker);
    if (track.observed[f]) track.before[f] = before.position(f, marker);
    if (track.observed_after[f]) track.after[f] = after.position(f, marker);
    if (!track.stated.empty()) track.stated[f] = trace.actions[f * before.marker_count() + marker];
  }
  return track;
}

// A cleaner that fills gaps sees no range: what it filled outside goes missing again.
void empty_outside(MarkerClip& clip, const MarkerClip& before, const std::vector<double>& weights) {
  const std::size_t markers = clip.marker_count();
  for (std::size_t i = 0; i < clip.observed.size(); ++i) {
    if (before.observed[i] != 0 || clip.observed[i] == 0 || weights[i / markers] > 0) continue;
    clip.observed[i] = 0;
    clip.positions[i] = before.positions[i];
    if (!clip.residuals.empty()) clip.residuals[i] = before.residuals[i];
  }
}

void add_fill_warnings(MarkerReport& report) {
  report.warnings.insert(report.warnings.end(), report.fill.warnings.begin(),
                         report.fill.warnings.end());
}

}  // namespace

MarkerResult clean_markers(const MarkerClip& clip, const Cleaner& cleaner,
                           const CleanSettings& settings, std::string method_name) {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t frames = clip.frame_count(), markers = clip.marker_count();
  check_settings(settings, frames);
  MarkerSelection selection{select_names(clip.names, settings, "marker"), body_height(clip)};
  const std::vector<double> weights = frame_weights(settings, frames, 0, clip.frame_rate_hz);

  MarkerResult result{clip, {}};
  MarkerReport& report = result.report;
  report.method = std::move(method_name);
  report.unit = clip.unit;
  report.frames = frames;
  report.frame_rate_hz = clip.frame_rate_hz;
  report.body_height = selection.body_height;
  for (std::size_t m = 0; m < markers; ++m)
    selection.markers[m] = marker_selected(clip, selection, m);
  if (settings.feet && settings.feet->mode != FeetMode::off) {
    report.warnings.emplace_back(
        "feet: markers are measured points and stay where they are; feet are held in takes of "
        "joints");
  }
  const MarkerTrace trace = cleaner.clean_markers(result.clip, selection);
  report.warnings.insert(report.warnings.end(), trace.warnings.begin(), trace.warnings.end());
  report.fall_backs = trace.fall_backs;
  if (settings.fill) {
    report.fill = fill_step(clip, cleaner, selection, weights, *settings.fill, trace, result.clip);
    add_fill_warnings(report);
  }

  empty_outside(result.clip, clip, weights);

  const std::vector<double> nothing(frames, 0.0);
  const MarkerScale scale{clip.frame_rate_hz, selection.body_height, clip.unit};
  std::vector<MarkerTrackReport> parts(markers);
  for_each_parallel(markers, clip.positions.size(), [&](std::size_t m) {
    MarkerTrack track = track_of(clip, result.clip, trace, m);
    const TrackChanges changes = blend_marker(track, selection.markers[m] ? weights : nothing,
                                              settings.max_change, 1e-13 * scale.body_height);
    for (std::size_t f = 0; f < frames; ++f) {
      if (track.observed[f]) result.clip.position(f, m) = track.after[f];
    }
    parts[m] = report_marker(clip.names[m], m, track, changes, scale, settings.peak_loss_limit);
  });
  for (std::size_t m = 0; m < markers; ++m) {
    if (!trace.noise.empty()) parts[m].summary.noise = trace.noise[m];
    report.markers.push_back(std::move(parts[m].summary));
    report.spans.insert(report.spans.end(), parts[m].spans.begin(), parts[m].spans.end());
    std::move(parts[m].warnings.begin(), parts[m].warnings.end(),
              std::back_inserter(report.warnings));
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace kinemend
