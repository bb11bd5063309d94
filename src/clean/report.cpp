#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clean/changes.hpp"
#include "clean/track_noise.hpp"
#include "clean/tracks.hpp"

namespace kinemend {

namespace {

bool repaired(Action action) {
  return action == Action::despiked || action == Action::filled || action == Action::foot_adjusted;
}

// Marks samples that lie far off the path of their neighbours: out and back within two frames is no
// motion of a person, and spikes that the method left in are no peaks.
void leave_out_spikes(const std::vector<Quat>& track, double noise_rad,
                      std::vector<std::uint8_t>& left_out) {
  constexpr double clear_noise = 8, clear_detour = 3;
  for (std::size_t f = 1; f + 1 < track.size(); ++f) {
    if (second_difference(track[f - 1], track[f], track[f + 1]) < 2 * clear_noise * noise_rad)
      continue;
    const double step =
        std::min(angle_between(track[f - 1], track[f]), angle_between(track[f], track[f + 1]));
    const double past = angle_between(track[f - 1], track[f + 1]);
    if (step > clear_noise * noise_rad && step > clear_detour * past) left_out[f] = 1;
  }
}

struct Peak {
  double speed_deg_s = 0;
  bool found = false;
};

// Largest turn within `gap` frames, as a speed. `left_out` marks samples that do not count.
Peak peak_speed(const std::vector<Quat>& track, const std::vector<std::uint8_t>& left_out,
                std::size_t gap, double rate_hz) {
  double least = 2;
  std::size_t at = 0;
  for (std::size_t f = 0; f + gap < track.size(); ++f) {
    if (left_out[f] || left_out[f + gap]) continue;
    const double cosine = std::fabs(dot(track[f], track[f + gap]));
    if (cosine < least) least = cosine, at = f;
  }
  if (least == 2) return {};
  const double angle = angle_between(track[at], track[at + gap]) * degrees_per_radian;
  return {angle * rate_hz / static_cast<double>(gap), true};
}

// Fills in the peaks and returns by how much noise may have raised the first one, degrees / s.
double measure_peaks(const std::vector<Quat>& before, const std::vector<Quat>& after,
                     std::vector<std::uint8_t> left_out, double rate_hz, JointSummary& summary) {
  constexpr double longest_s = 0.05;
  constexpr double noise_share = 0.1;
  constexpr std::size_t noise_samples = 1024;
  // Four standard deviations of the difference of two samples: the largest of many.
  const double noise_rad = track_noise(before, noise_samples);
  const double noise = 4 * std::sqrt(2.0) * noise_rad * degrees_per_radian;
  leave_out_spikes(before, noise_rad, left_out);
  const std::size_t most = frames_in(longest_s, rate_hz, 1);
  double noise_speed = 0;
  for (std::size_t gap = 1; gap <= most; ++gap) {
    const Peak peak = peak_speed(before, left_out, gap, rate_hz);
    if (!peak.found) break;
    summary.peak_speed_before_deg_s = peak.speed_deg_s;
    summary.peak_frames = gap;
    noise_speed = noise * rate_hz / static_cast<double>(gap);
    if (noise_speed <= noise_share * peak.speed_deg_s) break;
  }
  summary.peak_speed_after_deg_s =
      peak_speed(after, left_out, summary.peak_frames, rate_hz).speed_deg_s;
  return noise_speed;
}

std::string peak_warning(const JointSummary& summary, double noise_speed, double limit) {
  constexpr double slow_deg_s = 60;  // peaks below this are no events
  const double sure = summary.peak_speed_before_deg_s - noise_speed;
  if (sure < slow_deg_s || summary.peak_speed_after_deg_s >= (1 - limit) * sure) return {};
  const double loss = 1 - summary.peak_speed_after_deg_s / summary.peak_speed_before_deg_s;
  return fmt::format("{}: peak speed falls from {:.0f} to {:.0f} deg/s ({:.0f} %, limit {:.0f} %)",
                     summary.name, summary.peak_speed_before_deg_s, summary.peak_speed_after_deg_s,
                     100 * loss, 100 * limit);
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
  const double noise_speed =
      measure_peaks(tracks.before, tracks.after, left_out, frame_rate_hz, summary);
  report.warning = peak_warning(summary, noise_speed, peak_loss_limit);
  report.spans = spans_of(static_cast<std::int32_t>(joint), changes, first_frame);
  return report;
}

}  // namespace kinemend
