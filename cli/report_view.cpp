#include "report_view.hpp"

#include <utility>

namespace kinemend::cli {

namespace {

// What the reports of joints and of markers have alike.
template <class Report>
void take_common(Report& report, ReportView& view) {
  view.method = std::move(report.method);
  view.frames = report.frames;
  view.frame_rate_hz = report.frame_rate_hz;
  view.spans = std::move(report.spans);
  view.fill = std::move(report.fill);
  view.fall_backs = std::move(report.fall_backs);
  view.warnings = std::move(report.warnings);
  view.seconds = report.seconds;
}

}  // namespace

ReportView view_of(CleanReport report) {
  ReportView view;
  view.unit = "deg";
  view.noticeable_noise = 0.1;
  view.calibration_frames = report.calibration_frames;
  view.root_rms_change = report.root_rms_change;
  view.root_max_change = report.root_max_change;
  view.feet = std::move(report.feet);
  for (JointSummary& joint : report.joints) {
    view.rows.push_back({std::move(joint.name), joint.noise_deg, joint.rms_change_deg,
                         joint.max_change_deg, joint.frames_changed, joint.frames_repaired,
                         joint.peak_speed_before_deg_s, joint.peak_speed_after_deg_s,
                         joint.peak_frames, 0, 0});
  }
  take_common(report, view);
  return view;
}

ReportView view_of(MarkerReport report) {
  constexpr double noticeable_heights = 0.5 / 1750;  // half a millimetre of a person
  ReportView view;
  view.is_markers = true;
  view.unit = report.unit.empty() ? "units" : std::move(report.unit);
  view.noticeable_noise = noticeable_heights * report.body_height;
  for (MarkerSummary& marker : report.markers) {
    view.rows.push_back({std::move(marker.name), marker.noise, marker.rms_change, marker.max_change,
                         marker.frames_changed, marker.frames_repaired, marker.peak_speed_before,
                         marker.peak_speed_after, marker.peak_frames, marker.gaps_left,
                         marker.frames_missing});
  }
  take_common(report, view);
  return view;
}

}  // namespace kinemend::cli
