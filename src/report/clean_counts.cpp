// Counts the spans, tracks and frames of a cleaning report.
#include "report/clean_counts.hpp"

#include <algorithm>
#include <vector>

namespace kinemend {

std::size_t count_spans(const CleanReport& report, Action action) {
  return static_cast<std::size_t>(
      std::count_if(report.spans.begin(), report.spans.end(),
                    [&](const ReportSpan& span) { return span.action == action; }));
}

std::size_t count_bursts(const CleanReport& report) {
  // The least length of a burst. Chosen by hand.
  constexpr std::size_t fewest_frames = 3;
  return static_cast<std::size_t>(
      std::count_if(report.spans.begin(), report.spans.end(), [](const ReportSpan& span) {
        return span.action == Action::despiked &&
               span.last_frame - span.first_frame + 1 >= fewest_frames;
      }));
}

std::size_t tracks_counted(const CleanReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.tracks.begin(), report.tracks.end(),
                    [](const TrackSummary& track) { return track.is_position; }));
}

std::size_t tracks_changed(const CleanReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.tracks.begin(), report.tracks.end(),
                    [](const TrackSummary& track) { return track.frames_changed > 0; }));
}

std::size_t frames_repaired(const CleanReport& report) {
  std::vector<bool> repaired(report.frames, false);
  for (const ReportSpan& span : report.spans) {
    if (span.action != Action::despiked && span.action != Action::filled) continue;
    for (std::size_t f = span.first_frame; f <= span.last_frame && f < repaired.size(); ++f)
      repaired[f] = true;
  }
  return static_cast<std::size_t>(std::count(repaired.begin(), repaired.end(), true));
}

std::size_t gaps_left(const CleanReport& report) {
  std::size_t gaps = 0;
  for (const TrackSummary& track : report.tracks) gaps += track.gaps_left;
  return gaps;
}

double frames_per_second(const CleanReport& report) {
  return report.seconds > 0 ? static_cast<double>(report.frames) / report.seconds : 0;
}

bool is_changed(const CleanReport& report, std::int32_t track) {
  return track < 0 ? report.root_max_change > 0 : report.tracks[track].frames_changed > 0;
}

std::string track_name(const CleanReport& report, std::int32_t track) {
  return track < 0 ? "root position" : report.tracks[track].name;
}

std::size_t frames_adjusted(const FeetReport& report) {
  const std::size_t frames = report.root_changed.size();
  const std::size_t joints = frames > 0 ? report.changed.size() / frames : 0;
  std::size_t adjusted = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const auto row = report.changed.begin() + static_cast<std::ptrdiff_t>(f * joints);
    const auto end = row + static_cast<std::ptrdiff_t>(joints);
    adjusted += report.root_changed[f] != 0 || std::find(row, end, 1) != end ? 1 : 0;
  }
  return adjusted;
}

std::size_t contacts_held(const FeetReport& report) {
  return static_cast<std::size_t>(std::count(report.held.begin(), report.held.end(), 1));
}

}  // namespace kinemend
