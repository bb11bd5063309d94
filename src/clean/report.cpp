// Writes the report of each track: its summary, its spans, lost peaks and large changes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/text.hpp"
#include "clean/changes.hpp"
#include "metrics/track_noise.hpp"

namespace kinemend {

namespace {

// The noise samples, for speed; the limit of a slow peak, and of a small change. Chosen by hand,
// not swept.
constexpr std::size_t noise_samples = 1024;
constexpr double slow_deg_s = 60;
constexpr double slow_heights_s = 0.25;  // for markers, statures a second
constexpr double small_change_deg = 10, small_change_heights = 0.04;

// A held foot is adjusted, not repaired, so its speed counts.
bool repaired(Action action) { return action == Action::despiked || action == Action::filled; }

// Ignores peaks below `scale.slow`.
std::optional<PeakLoss> lost_peak(const Peaks& peaks, const ReportScale& scale) {
  const double before = peaks.before * scale.per_sample_unit;
  const double after = peaks.after * scale.per_sample_unit;
  const double sure = before - peaks.noise * scale.per_sample_unit;
  if (sure < scale.slow || after >= (1 - scale.peak_loss_limit) * sure) return std::nullopt;
  return PeakLoss{before, after, 1 - peaks.after / peaks.before};
}

// Smoothing removes noise. A change far above the largest noise to be expected was a spike that the
// method did not state, or it was motion.
std::optional<LargeChange> large_change(const TrackChanges& changes, double noise,
                                        const ReportScale& scale) {
  // Chosen by hand, not swept.
  constexpr double clearly = 2;
  const double limit =
      std::max(scale.small_change, clearly * longest_of_noise(changes.amounts.size()) * noise);
  std::size_t largest = 0, count = 0;
  for (std::size_t f = 0; f < changes.amounts.size(); ++f) {
    if (changes.actions[f] != Action::denoised || changes.amounts[f] <= limit) continue;
    if (count++ == 0 || changes.amounts[f] > changes.amounts[largest]) largest = f;
  }
  if (count == 0) return std::nullopt;
  const auto frame = static_cast<double>(scale.first_frame + largest);
  return LargeChange{changes.amounts[largest], noise, frame / scale.frame_rate_hz, count};
}

std::string text_of(const PeakLoss& loss, const ReportScale& scale) {
  return fmt::format("from {:.4g} to {:.4g} {}", loss.before, loss.after, scale.speed_unit);
}

std::string text_of(const LargeChange& change, const ReportScale& scale) {
  return fmt::format("{} at {:.2f} s", measure_text(change.size, scale.unit), change.time_s);
}

// Returns the tracks that have a `member`, worst first by `size`.
template <class Event, class Size>
std::vector<const TrackReport*> worst_first(const std::vector<TrackReport>& tracks,
                                            std::optional<Event> TrackReport::*member,
                                            const Size& size) {
  std::vector<const TrackReport*> found;
  for (const TrackReport& track : tracks) {
    if (track.*member) found.push_back(&track);
  }
  std::stable_sort(found.begin(), found.end(), [&](const auto* a, const auto* b) {
    return size(*(a->*member)) > size(*(b->*member));
  });
  return found;
}

// Returns the first three as "A (x), B (y), C (z)".
template <class Text>
std::string worst_text(const std::vector<const TrackReport*>& found, const Text& text) {
  // Chosen by hand.
  constexpr std::size_t most_named = 3;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(found.size(), most_named); ++i)
    parts.push_back(fmt::format("{} ({})", found[i]->summary.name, text(*found[i])));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string peak_warning(const std::vector<const TrackReport*>& found, const char* noun,
                         const ReportScale& scale) {
  const double limit = 100 * scale.peak_loss_limit;
  if (found.size() == 1) {
    const PeakLoss& loss = *found[0]->lost_peak;
    return fmt::format("{}: peak speed falls {} ({:.0f} %, limit {:.0f} %)", found[0]->summary.name,
                       text_of(loss, scale), 100 * loss.share, limit);
  }
  return fmt::format("peak speed falls by more than {:.0f} % on {} {}s, most on {}", limit,
                     found.size(), noun, worst_text(found, [&](const TrackReport& track) {
                       return fmt::format("{}, {:.0f} %", text_of(*track.lost_peak, scale),
                                          100 * track.lost_peak->share);
                     }));
}

std::string change_warning(const std::vector<const TrackReport*>& found, const char* noun,
                           const ReportScale& scale) {
  if (found.size() == 1) {
    const LargeChange& change = *found[0]->large_change;
    return fmt::format("{}: smoothing changes it by {}, where its noise is {}{}",
                       found[0]->summary.name, text_of(change, scale),
                       measure_text(change.noise, scale.unit),
                       change.count > 1 ? fmt::format(" ({} such frames)", change.count) : "");
  }
  return fmt::format("smoothing changes {} {}s by far more than their noise, most {}", found.size(),
                     noun, worst_text(found, [&](const TrackReport& track) {
                       return fmt::format("{}, noise {}", text_of(*track.large_change, scale),
                                          measure_text(track.large_change->noise, scale.unit));
                     }));
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
                         const TrackChanges& changes, const TrackMeasure& measure,
                         const ColouredNoise& taken, const ReportScale& scale) {
  const std::size_t frames = track.before.size();
  const bool cut = scale.gaps == GapTreatment::cut;
  TrackReport report;
  TrackSummary& summary = report.summary;
  summary.name = std::move(name);
  report.spans = spans_of(static_cast<std::int32_t>(owner), changes, scale.first_frame);
  std::vector<std::uint8_t> left_out(frames);      // spikes and gaps, whatever the method did
  std::vector<std::uint8_t> not_followed(frames);  // those, and samples that the method repaired
  std::vector<Sample> counted;  // samples of the figures; bridged ones of a joint count too
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
    left_out[f] = !seen || (!measure.spikes.empty() && measure.spikes[f] != 0);
    not_followed[f] = left_out[f] || repaired(changes.actions[f]);
    if (seen || !cut) counted.push_back(track.before[f]);
  }
  if (counted.empty()) return report;
  summary.rms_change = std::sqrt(squares / static_cast<double>(counted.size()));
  const double white = track_noise(counted, noise_samples);
  const auto sample_noise = [&](const ColouredNoise& noise) {
    if (noise.correlation == 0) return SampleNoise{white, white, 0};
    return SampleNoise{white, noise.strength / scale.per_sample_unit, noise.correlation};
  };
  const SampleNoise measured = sample_noise(measure.coloured);
  const Peaks peaks =
      measure_peaks(track.before, track.after, std::move(left_out), measured, scale.frame_rate_hz);
  summary.peak_speed_before = peaks.before * scale.per_sample_unit;
  summary.peak_speed_after = peaks.after * scale.per_sample_unit;
  summary.peak_frames = peaks.frames;
  summary.noise = measured.strength * scale.per_sample_unit;
  report.lost_peak = lost_peak(peaks, scale);
  const SampleNoise explained = sample_noise(taken);
  if (report.lost_peak) {
    // A peak is not lost if the method repaired it, or if the removed noise explains it.
    const Peaks own = measure_peaks(track.before, track.after, std::move(not_followed), explained,
                                    scale.frame_rate_hz);
    if (!lost_peak(own, scale)) report.lost_peak.reset();
  }
  report.large_change = large_change(
      changes, std::max(measured.strength, explained.strength) * scale.per_sample_unit, scale);
  return report;
}

const char* noun_of(TakeKind kind) { return kind == TakeKind::markers ? "marker" : "joint"; }

std::vector<std::string> warnings_of(const std::vector<TrackReport>& tracks, TakeKind kind,
                                     const ReportScale& scale) {
  const char* const noun = noun_of(kind);
  std::vector<std::string> warnings;
  const auto losses =
      worst_first(tracks, &TrackReport::lost_peak, [](const PeakLoss& loss) { return loss.share; });
  if (!losses.empty()) warnings.push_back(peak_warning(losses, noun, scale));
  const auto changes = worst_first(tracks, &TrackReport::large_change,
                                   [](const LargeChange& change) { return change.size; });
  if (!changes.empty()) warnings.push_back(change_warning(changes, noun, scale));
  return warnings;
}

template TrackReport report_track(std::string, std::size_t, const TrackEdit<Quat>&,
                                  const TrackChanges&, const TrackMeasure&, const ColouredNoise&,
                                  const ReportScale&);
template TrackReport report_track(std::string, std::size_t, const TrackEdit<Vec3>&,
                                  const TrackChanges&, const TrackMeasure&, const ColouredNoise&,
                                  const ReportScale&);

}  // namespace kinemend
