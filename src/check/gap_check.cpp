// Reports the gaps of each track.
#include <algorithm>

#include "check/checks.hpp"

namespace kinemend::check {

void check_gaps(const std::vector<Gap>& gap_list, const std::vector<std::int32_t>& track_of,
                CheckReport& report) {
  // The level `serious` of docs/check.md. Chosen by hand, not swept.
  constexpr double long_gap_s = 0.5;  // longer gaps need a model to be filled reliably
  std::size_t missing = 0;
  for (const Gap& gap : gap_list) {
    if (track_of[gap.track] < 0) continue;
    TrackHealth& track = report.tracks[static_cast<std::size_t>(track_of[gap.track])];
    const double seconds = static_cast<double>(gap.length()) / report.frame_rate_hz;
    ++track.gaps;
    track.longest_gap = std::max(track.longest_gap, gap.length());
    track.missing_frames += gap.length();
    missing += gap.length();
    ++report.figures.gaps;
    report.figures.longest_gap_s = std::max(report.figures.longest_gap_s, seconds);
    const bool never_seen = gap.length() == report.frames - report.calibration_frames;
    report.findings.push_back({FindingKind::gap,
                               seconds >= long_gap_s ? Severity::serious : Severity::warning,
                               track.name, gap.first_frame, gap.last_frame, seconds, "s",
                               never_seen ? "is never seen" : "is missing"});
  }
  const std::size_t samples = report.tracks.size() * (report.frames - report.calibration_frames);
  if (samples > 0) {
    report.figures.missing_percent =
        100.0 * static_cast<double>(missing) / static_cast<double>(samples);
  }
}

}  // namespace kinemend::check
