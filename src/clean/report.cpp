#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "clean/changes.hpp"
#include "clean/clip_tracks.hpp"
#include "metrics/peaks.hpp"
#include "metrics/track_noise.hpp"

namespace kinemend {

namespace {

constexpr std::size_t noise_samples = 1024;
constexpr double slow_deg_s = 60;
constexpr double slow_heights_s = 0.25;  // of markers, statures a second
constexpr double small_change_deg = 10, small_change_heights = 0.04;

// A foot that is held is moved, not repaired: how fast it goes counts.
bool repaired(Action action) { return action == Action::despiked || action == Action::filled; }

// `scale` and `unit`: of speeds as they are shown. Peaks below `slow` are no events.
std::string peak_warning(const std::string& name, const Peaks& peaks, double scale,
                         std::string_view unit, double slow, double limit) {
  const double sure = (peaks.before - peaks.noise) * scale;
  if (sure < slow || peaks.after * scale >= (1 - limit) * sure) return {};
  const double loss = 1 - peaks.after / peaks.before;
  return fmt::format("{}: peak speed falls from {:.4g} to {:.4g} {} ({:.0f} %, limit {:.0f} %)",
                     name, peaks.before * scale, peaks.after * scale, unit, 100 * loss,
                     100 * limit);
}

// Smoothing takes noise away; what it changes by far more than the largest noise there may be was a
// spike to everybody but the method, or motion. `least` is no event; the first sample is at
// `begin_s`.
std::string change_warning(const std::string& name, const TrackChanges& changes, double noise,
                           std::string_view unit, double least, double begin_s, double rate_hz) {
  constexpr double clearly = 2;
  const double limit = std::max(least, clearly * longest_of_noise(changes.amounts.size()) * noise);
  std::size_t largest = 0, count = 0;
  for (std::size_t f = 0; f < changes.amounts.size(); ++f) {
    if (changes.actions[f] != Action::denoised || changes.amounts[f] <= limit) continue;
    if (count++ == 0 || changes.amounts[f] > changes.amounts[largest]) largest = f;
  }
  if (count == 0) return {};
  return fmt::format(
      "{}: smoothing changes it by {:.3g} {} at {:.2f} s, where its noise is {:.2g}{}", name,
      changes.amounts[largest], unit, begin_s + static_cast<double>(largest) / rate_hz, noise,
      count > 1 ? fmt::format(" ({} such frames)", count) : "");
}

void add(std::string warning, std::vector<std::string>& warnings) {
  if (!warning.empty()) warnings.push_back(std::move(warning));
}

}  // namespace

std::vector<ReportSpan> spans_of(std::int32_t joint, const TrackChanges& changes,
                                 std::size_t first_frame) {
  std::vector<ReportSpan> spans;
  const std::size_t frames = changes.amounts.size();
  for (std::size_t f = 0; f < frames;) {
    ReportSpan span{joint, first_frame + f, 0, changes.actions[f], 0, 0};
    double squares = 0;
    const std::size_t start = f;
    for (; f < frames && changes.actions[f] == span.action; ++f) {
      span.max_change = std::max(span.max_change, changes.amounts[f]);
      squares += changes.amounts[f] * changes.amounts[f];
    }
    span.last_frame = first_frame + f - 1;
    span.rms_change = std::sqrt(squares / static_cast<double>(f - start));
    if (span.action != Action::kept) spans.push_back(span);
  }
  return spans;
}

JointReport report_joint(const std::string& name, std::size_t joint, const JointTracks& tracks,
                         const TrackChanges& changes, std::size_t first_frame, double frame_rate_hz,
                         double peak_loss_limit) {
  const std::size_t frames = tracks.before.size();
  JointReport report;
  JointSummary& summary = report.summary;
  summary.name = name;
  std::vector<std::uint8_t> left_out(frames);
  double squares = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const double change = changes.amounts[f];
    squares += change * change;
    summary.max_change_deg = std::max(summary.max_change_deg, change);
    summary.frames_changed += change > 0;
    summary.frames_repaired += repaired(changes.actions[f]);
    const bool seen = tracks.observed.empty() || tracks.observed[f] != 0;
    left_out[f] = repaired(changes.actions[f]) || !seen;
  }
  if (frames > 0) summary.rms_change_deg = std::sqrt(squares / static_cast<double>(frames));
  const double noise = track_noise(tracks.before, noise_samples);
  const Peaks peaks =
      measure_peaks(tracks.before, tracks.after, std::move(left_out), noise, frame_rate_hz);
  summary.peak_speed_before_deg_s = peaks.before * degrees_per_radian;
  summary.peak_speed_after_deg_s = peaks.after * degrees_per_radian;
  summary.peak_frames = peaks.frames;
  add(peak_warning(name, peaks, degrees_per_radian, "deg/s", slow_deg_s, peak_loss_limit),
      report.warnings);
  add(change_warning(name, changes, noise * degrees_per_radian, "deg", small_change_deg,
                     static_cast<double>(first_frame) / frame_rate_hz, frame_rate_hz),
      report.warnings);
  report.spans = spans_of(static_cast<std::int32_t>(joint), changes, first_frame);
  return report;
}

MarkerTrackReport report_marker(const std::string& name, std::size_t marker,
                                const MarkerTrack& track, const TrackChanges& changes,
                                const MarkerScale& scale, double peak_loss_limit) {
  const std::size_t frames = track.before.size();
  MarkerTrackReport report;
  MarkerSummary& summary = report.summary;
  summary.name = name;
  std::vector<std::uint8_t> left_out(frames);
  std::vector<Vec3> seen;
  double squares = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const double change = changes.amounts[f];
    squares += change * change;
    summary.max_change = std::max(summary.max_change, change);
    summary.frames_changed += changes.actions[f] != Action::kept;
    summary.frames_repaired += repaired(changes.actions[f]);
    if (!track.observed_after[f]) {
      ++summary.frames_missing;
      summary.gaps_left += f == 0 || track.observed_after[f - 1] != 0;
    }
    left_out[f] = repaired(changes.actions[f]) || !track.observed[f];
    if (track.observed[f]) seen.push_back(track.before[f]);
  }
  if (seen.empty()) {
    report.spans = spans_of(static_cast<std::int32_t>(marker), changes, 0);
    return report;
  }
  summary.rms_change = std::sqrt(squares / static_cast<double>(seen.size()));
  const double noise = track_noise(seen, noise_samples);
  const Peaks peaks =
      measure_peaks(track.before, track.after, std::move(left_out), noise, scale.frame_rate_hz);
  summary.peak_speed_before = peaks.before;
  summary.peak_speed_after = peaks.after;
  summary.peak_frames = peaks.frames;
  const std::string unit = scale.unit.empty() ? "units" : scale.unit;
  add(peak_warning(name, peaks, 1, unit + "/s", slow_heights_s * scale.body_height,
                   peak_loss_limit),
      report.warnings);
  add(change_warning(name, changes, noise, unit, small_change_heights * scale.body_height, 0,
                     scale.frame_rate_hz),
      report.warnings);
  report.spans = spans_of(static_cast<std::int32_t>(marker), changes, 0);
  return report;
}

}  // namespace kinemend
