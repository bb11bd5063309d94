// Runs all checks on a take and puts their findings in order.
#include "kinemend/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "check/checks.hpp"
#include "kinemend/error.hpp"
#include "motion/names.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

void check_range(double value, const char* name) {
  if (value >= 0 && value <= 1e9) return;
  throw Error(ErrorKind::usage, fmt::format("{} {} is outside 0 to 1e9", name, value));
}

void check_above_0(double value, const char* name) {
  if (value > 0 && value <= 1e9) return;
  throw Error(ErrorKind::usage, fmt::format("{} {} is not above 0, up to 1e9", name, value));
}

void validate(const JointLimits& limits) {
  check_above_0(limits.speed_deg_s, "speed_deg_s");
  check_above_0(limits.acceleration_deg_s2, "acceleration_deg_s2");
}

void validate(const RobotSettings& settings) {
  validate(settings.limits);
  for (const NamedJointLimits& joint : settings.joints) validate(joint.limits);
  if (!(settings.step_s >= 0.001 && settings.step_s <= 1))
    throw Error(ErrorKind::usage, fmt::format("step_s {} is outside 0.001 to 1", settings.step_s));
  check_range(settings.penetration_cm, "penetration_cm");
  check_range(settings.floating_cm, "floating_cm");
  check_above_0(settings.jump_deg, "jump_deg");
  check_above_0(settings.jump_cm, "jump_cm");
  check_range(settings.floor_cm, "floor_cm");
}

void validate(const CheckSettings& settings) {
  check_range(settings.noise_deg, "noise_deg");
  check_range(settings.noise_cm, "noise_cm");
  check_range(settings.shortest_stale_s, "shortest_stale_s");
  check_range(settings.slide_cm, "slide_cm");
  check_range(settings.sink_cm, "sink_cm");
  check_range(settings.length_change_percent, "length_change_percent");
  if (settings.metres_per_unit) check_range(*settings.metres_per_unit, "metres_per_unit");
  if (settings.robot) validate(*settings.robot);
}

// Shifts the frames, because the checks read the take without its calibration frames.
void shift_frames(CheckReport& report, std::size_t frames) {
  for (Finding& finding : report.findings) {
    finding.first_frame += frames;
    finding.last_frame += frames;
  }
  for (NamedGap& gap : report.stale) {
    gap.first_frame += frames;
    gap.last_frame += frames;
  }
  if (!report.robot) return;
  for (FootContact& contact : report.robot->contacts) {
    contact.first_frame += frames;
    contact.last_frame += frames;
  }
}

void report_calibration(CheckReport& report) {
  const std::size_t count = report.calibration_frames;
  if (count == 0) return;
  report.findings.push_back({FindingKind::calibration, Severity::note, "", 0, count - 1,
                             static_cast<double>(count), "frames",
                             count == 1 ? "is a calibration pose, not part of the motion"
                                        : "are a calibration pose, not part of the motion"});
}

void report_left_out(const Take& clip, const std::vector<std::size_t>& markers,
                     CheckReport& report) {
  const std::size_t count = clip.marker_count() - markers.size();
  if (count == 0) return;
  const std::size_t last = std::max<std::size_t>(report.frames, 1) - 1;
  report.findings.push_back({FindingKind::left_out, Severity::note, "", 0, last,
                             static_cast<double>(count), "points",
                             "angles, forces and the like among the points are ignored"});
}

// Returns a report with a row for each joint.
CheckReport report_on_joints(const Take& clip) {
  clip.validate();
  CheckReport report;
  report.frames = clip.frame_count();
  report.frame_rate_hz = clip.frame_rate_hz;
  report.noise_unit = "deg";
  for (const std::string& name : clip.skeleton.names) report.tracks.push_back({name});
  report.calibration_frames = leading_calibration_frames(clip);
  return report;
}

void check_gaps_of(const Take& motion, CheckReport& report) {
  std::vector<std::int32_t> track_of(motion.joint_count());
  std::iota(track_of.begin(), track_of.end(), 0);
  check::check_gaps(find_gaps(motion), track_of, report);
}

// The marker of each row of a report, and the row of each marker, -1 for none.
struct MarkerRows {
  std::vector<std::size_t> markers;
  std::vector<std::int32_t> track_of;
};

// Returns a report with a row for each marker that is a position.
CheckReport report_on_markers(const Take& clip, MarkerRows& rows) {
  clip.validate();
  CheckReport report;
  report.is_markers = true;
  report.frames = clip.frame_count();
  report.frame_rate_hz = clip.frame_rate_hz;
  report.noise_unit = clip.unit;
  rows.track_of.assign(clip.marker_count(), -1);
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (!clip.holds_positions(m)) continue;
    rows.track_of[m] = static_cast<std::int32_t>(rows.markers.size());
    rows.markers.push_back(m);
    report.tracks.push_back({clip.names[m]});
  }
  return report;
}

std::vector<Finding> beyond_cleaning(std::vector<Finding> findings) {
  const auto is_less = [](const Finding& finding) {
    const bool is_stale =
        finding.kind == FindingKind::frozen || finding.kind == FindingKind::bridged;
    return !is_stale && finding.severity != Severity::serious;
  };
  findings.erase(std::remove_if(findings.begin(), findings.end(), is_less), findings.end());
  check::sort_worst_first(findings);
  return findings;
}

CheckReport check_joints(const Take& clip, const CheckSettings& settings) {
  CheckReport report = report_on_joints(clip);
  report.source = source_of(clip, settings.source);
  std::optional<Take> sliced;
  const Take& motion = frames_from(clip, report.calibration_frames, sliced);
  check_gaps_of(motion, report);
  check::check_noise_and_spikes(motion, settings, report);
  check::check_stale(motion, settings, report);
  check::check_lengths(motion, settings, report);
  check::check_frames(motion, report);
  check::check_unit(clip, settings, report);
  check::check_body(motion, settings, report);
  if (settings.robot) {
    check::check_joint_limits(motion, *settings.robot, report);
    check::check_jumps(motion, *settings.robot, report);
    check::check_robot_feet(motion, settings, report);
  }
  shift_frames(report, report.calibration_frames);
  check::check_zero_frames(clip, report);
  check::check_euler_flips(clip, report);
  report_calibration(report);
  check::sort_worst_first(report.findings);
  return report;
}

CheckReport check_markers(const Take& clip, const CheckSettings& settings) {
  MarkerRows rows;
  CheckReport report = report_on_markers(clip, rows);
  report.source = source_of(clip, settings.source);
  const auto& [markers, track_of] = rows;
  const std::vector<Subject> subjects = subjects_of(clip);
  check::check_unit(clip, largest_subject(clip).markers, settings, report);
  check::check_gaps(find_gaps(clip), track_of, report);
  check::check_swaps(clip, track_of, report);
  // Without this, other checks would report an exchange of labels twice for both tracks.
  Take labelled = clip;
  undo_swaps(labelled, report.swaps);
  check::check_noise_and_spikes(labelled, markers, settings, report);
  check::check_stale(labelled, markers, settings, report);
  for (const Subject& subject : subjects)
    check::check_lengths(labelled, subject.markers, settings, report);
  check::check_frames(labelled, markers, report);
  check::check_body(labelled, subjects, settings, report);
  if (settings.robot) {
    check::check_jumps(labelled, markers, *settings.robot, report);
    check::check_robot_feet(labelled, subjects, settings, report);
  }
  report_left_out(clip, markers, report);
  check::sort_worst_first(report.findings);
  return report;
}

std::vector<Finding> beyond_cleaning_of_joints(const Take& clip) {
  const CheckSettings settings;
  CheckReport report = report_on_joints(clip);
  std::optional<Take> sliced;
  const Take& motion = frames_from(clip, report.calibration_frames, sliced);
  check_gaps_of(motion, report);
  check::check_stale(motion, settings, report);
  check::check_frames(motion, report);
  check::check_unit(clip, settings, report);
  shift_frames(report, report.calibration_frames);
  check::check_zero_frames(clip, report);
  return beyond_cleaning(std::move(report.findings));
}

std::vector<Finding> beyond_cleaning_of_markers(const Take& clip) {
  const CheckSettings settings;
  MarkerRows rows;
  CheckReport report = report_on_markers(clip, rows);
  check::check_unit(clip, largest_subject(clip).markers, settings, report);
  check::check_gaps(find_gaps(clip), rows.track_of, report);
  check::check_swaps(clip, rows.track_of, report);
  check::check_stale(clip, rows.markers, settings, report);
  check::check_frames(clip, rows.markers, report);
  return beyond_cleaning(std::move(report.findings));
}

}  // namespace

CheckReport check_take(const Take& take, const CheckSettings& settings) {
  validate(settings);
  return take.has_joints() ? check_joints(take, settings) : check_markers(take, settings);
}

std::vector<Finding> find_beyond_cleaning(const Take& take) {
  return take.has_joints() ? beyond_cleaning_of_joints(take) : beyond_cleaning_of_markers(take);
}

}  // namespace kinemend
