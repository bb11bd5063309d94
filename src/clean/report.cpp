#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "clean/changes.hpp"
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
// spike to everybody but the method, or motion.
std::string change_warning(const std::string& name, const TrackChanges& changes, double noise,
                           const ReportScale& scale) {
  constexpr double clearly = 2;
  const double limit =
      std::max(scale.small_change, clearly * longest_of_noise(changes.amounts.size()) * noise);
  std::size_t largest = 0, count = 0;
  for (std::size_t f = 0; f < changes.amounts.size(); ++f) {
    if (changes.actions[f] != Action::denoised || changes.amounts[f] <= limit) continue;
    if (count++ == 0 || changes.amounts[f] > changes.amounts[largest]) largest = f;
  }
  if (count == 0) return {};
  const double begin_s = static_cast<double>(scale.first_frame) / scale.frame_rate_hz;
  return fmt::format(
      "{}: smoothing changes it by {:.3g} {} at {:.2f} s, where its noise is {:.2g}{}", name,
      changes.amounts[largest], scale.unit,
      begin_s + static_cast<double>(largest) / scale.frame_rate_hz, noise,
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

ReportScale joint_scale() {
  ReportScale scale;
  scale.per_sample_unit = degrees_per_radian;
  scale.unit = "deg";
  scale.speed_unit = "deg/s";
  scale.slow = slow_deg_s;
  scale.small_change = small_change_deg;
  return scale;
}

ReportScale marker_scale(const std::string& unit, double body_height) {
  ReportScale scale;
  scale.gaps = GapTreatment::cut;
  scale.unit = unit.empty() ? "units" : unit;
  scale.speed_unit = scale.unit + "/s";
  scale.slow = slow_heights_s * body_height;
  scale.small_change = small_change_heights * body_height;
  return scale;
}

template <class Sample>
TrackReport report_track(std::string name, std::size_t owner, const TrackEdit<Sample>& track,
                         const TrackChanges& changes, const ColouredNoise& noise,
                         const ReportScale& scale) {
  const std::size_t frames = track.before.size();
  const bool cut = scale.gaps == GapTreatment::cut;
  TrackReport report;
  TrackSummary& summary = report.summary;
  summary.name = std::move(name);
  report.spans = spans_of(static_cast<std::int32_t>(owner), changes, scale.first_frame);
  std::vector<std::uint8_t> left_out(frames);
  std::vector<Sample> counted;  // of a joint a bridge counts, too
  double squares = 0;
  bool was_missing = false;
  for (std::size_t f = 0; f < frames; ++f) {
    const double change = changes.amounts[f];
    const bool seen = track.is_observed(f);
    squares += change * change;
    summary.max_change = std::max(summary.max_change, change);
    summary.frames_changed += changes.actions[f] != Action::kept;
    summary.frames_repaired += repaired(changes.actions[f]);
    const bool is_missing = cut && !seen && changes.actions[f] != Action::filled;
    summary.frames_missing += is_missing;
    summary.gaps_left += is_missing && !was_missing;
    was_missing = is_missing;
    left_out[f] = repaired(changes.actions[f]) || !seen;
    if (seen || !cut) counted.push_back(track.before[f]);
  }
  if (counted.empty()) return report;
  summary.rms_change = std::sqrt(squares / static_cast<double>(counted.size()));
  const double white = track_noise(counted, noise_samples);
  const bool is_white = noise.correlation == 0;
  const double strength = is_white ? white : noise.strength / scale.per_sample_unit;
  const Peaks peaks = measure_peaks(track.before, track.after, std::move(left_out),
                                    {white, strength, noise.correlation}, scale.frame_rate_hz);
  summary.peak_speed_before = peaks.before * scale.per_sample_unit;
  summary.peak_speed_after = peaks.after * scale.per_sample_unit;
  summary.peak_frames = peaks.frames;
  add(peak_warning(summary.name, peaks, scale.per_sample_unit, scale.speed_unit, scale.slow,
                   scale.peak_loss_limit),
      report.warnings);
  add(change_warning(summary.name, changes, strength * scale.per_sample_unit, scale),
      report.warnings);
  return report;
}

template TrackReport report_track(std::string, std::size_t, const TrackEdit<Quat>&,
                                  const TrackChanges&, const ColouredNoise&, const ReportScale&);
template TrackReport report_track(std::string, std::size_t, const TrackEdit<Vec3>&,
                                  const TrackChanges&, const ColouredNoise&, const ReportScale&);

}  // namespace kinemend
