// Runs all checks on a take and puts their findings in order.
#include "kinemend/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "check/checks.hpp"
#include "kinemend/error.hpp"
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
}

void report_calibration(CheckReport& report) {
  const std::size_t count = report.calibration_frames;
  if (count == 0) return;
  report.findings.push_back({FindingKind::calibration, Severity::note, "", 0, count - 1,
                             static_cast<double>(count), "frames",
                             count == 1 ? "is a calibration pose, not part of the motion"
                                        : "are a calibration pose, not part of the motion"});
}

void report_left_out(const check::Rows& rows, CheckReport& report) {
  const std::size_t count = rows.clip.marker_count() - rows.tracks.size();
  if (count == 0) return;
  const std::size_t last = std::max<std::size_t>(report.frames, 1) - 1;
  report.findings.push_back({FindingKind::left_out, Severity::note, "", 0, last,
                             static_cast<double>(count), "points",
                             "angles, forces and the like among the points are ignored"});
}

// Returns a report with a row for each joint, or for each marker that is a position.
CheckReport report_on(const Take& take) {
  take.validate();
  CheckReport report;
  report.is_markers = !take.has_joints();
  report.frames = take.frame_count();
  report.frame_rate_hz = take.frame_rate_hz;
  report.noise_unit = take.has_joints() ? "deg" : take.unit;
  if (take.has_joints()) report.calibration_frames = leading_calibration_frames(take);
  for (std::size_t n = 0; n < take.owner_names().size(); ++n) {
    if (take.has_joints() || take.holds_positions(n))
      report.tracks.push_back({take.owner_names()[n]});
  }
  return report;
}

// Returns the rows of `report_on`. `motion`: the take without its calibration frames.
check::Rows rows_of(const Take& motion) {
  check::Rows rows{motion, {}, std::vector<std::int32_t>(motion.owner_names().size(), -1)};
  for (std::size_t n = 0; n < rows.row_of.size(); ++n) {
    if (!motion.has_joints() && !motion.holds_positions(n)) continue;
    rows.row_of[n] = static_cast<std::int32_t>(rows.tracks.size());
    rows.tracks.push_back(n);
  }
  if (!motion.has_joints()) rows.subjects = subjects_of(motion);
  return rows;
}

// Runs the checks of the whole take, on its rows without calibration frames. `labelled`: the same
// rows with exchanges of labels undone.
void check_rows(const check::Rows& labelled, const CheckSettings& settings, CheckReport& report) {
  check::check_noise_and_spikes(labelled, settings, report);
  check::check_stale(labelled, settings, report);
  check::check_lengths(labelled, settings, report);
  check::check_frames(labelled, report);
  check::check_body(labelled, settings, report);
  if (!settings.robot) {
    check::check_root_jumps(labelled, report);
    return;
  }
  if (labelled.clip.has_joints()) check::check_joint_limits(labelled.clip, *settings.robot, report);
  check::check_jumps(labelled, *settings.robot, report);
  check::check_robot_feet(labelled, settings, report);
}

void add_stands(const Take& take, const CheckSettings& settings, CheckReport& report) {
  if ((!settings.with_stands && !settings.robot) || report.frames == 0) return;
  ContactSettings contact;
  contact.up = settings.up;
  report.stands = find_stands(take, contact, settings.names, report.metres_per_unit);
  if (report.is_markers)
    report.plate_stands = check::plate_stands(take, report.stands, settings.plates);
}

}  // namespace

CheckReport check_take(const Take& take, const CheckSettings& settings) {
  validate(settings);
  CheckReport report = report_on(take);
  report.source = source_of(take, settings.source);
  std::optional<Take> sliced;
  const check::Rows rows = rows_of(frames_from(take, report.calibration_frames, sliced));
  check::check_unit(take, settings, report);
  check::check_gaps(rows, report);
  if (take.has_joints()) {
    add_stands(take, settings, report);
    check_rows(rows, settings, report);
    shift_frames(report, report.calibration_frames);
    check::check_zero_frames(take, report);
    check::check_euler_flips(take, report);
    report_calibration(report);
  } else {
    check::check_swaps(rows, report);
    // Without this, other checks would report an exchange of labels twice for both tracks.
    Take labelled = take;
    undo_swaps(labelled, report.swaps);
    add_stands(labelled, settings, report);
    check_rows(rows.of(labelled), settings, report);
    report_left_out(rows, report);
  }
  check::sort_worst_first(report.findings);
  return report;
}

std::vector<Finding> find_beyond_cleaning(const Take& take) {
  const CheckSettings settings;
  CheckReport report = report_on(take);
  std::optional<Take> sliced;
  const check::Rows rows = rows_of(frames_from(take, report.calibration_frames, sliced));
  check::check_unit(take, settings, report);
  check::check_gaps(rows, report);
  if (!take.has_joints()) check::check_swaps(rows, report);
  check::check_stale(rows, settings, report);
  check::check_frames(rows, report);
  shift_frames(report, report.calibration_frames);
  if (take.has_joints()) check::check_zero_frames(take, report);
  std::erase_if(report.findings, [](const Finding& finding) {
    const bool is_stale =
        finding.kind == FindingKind::frozen || finding.kind == FindingKind::bridged;
    return !is_stale && finding.severity != Severity::serious;
  });
  check::sort_worst_first(report.findings);
  return std::move(report.findings);
}

}  // namespace kinemend
