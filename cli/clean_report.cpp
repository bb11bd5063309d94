#include "clean_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "json.hpp"
#include "table.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

constexpr std::size_t short_list = 8;
// Below this much jitter a take is not called noisy.
constexpr double noticeable_deg = 0.1;

bool is_repair(Action action) {
  return action == Action::despiked || action == Action::filled || action == Action::foot_adjusted;
}

std::size_t count_spans(const CleanReport& report, Action action) {
  return static_cast<std::size_t>(
      std::count_if(report.spans.begin(), report.spans.end(),
                    [&](const ReportSpan& span) { return span.action == action; }));
}

std::size_t count_changed(const CleanReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.joints.begin(), report.joints.end(),
                    [](const JointSummary& joint) { return joint.frames_changed > 0; }));
}

/// Frames in which at least one joint was repaired.
std::size_t frames_repaired(const CleanReport& report) {
  std::vector<bool> repaired(report.frames, false);
  for (const ReportSpan& span : report.spans) {
    if (!is_repair(span.action)) continue;
    for (std::size_t f = span.first_frame; f <= span.last_frame && f < repaired.size(); ++f)
      repaired[f] = true;
  }
  return static_cast<std::size_t>(std::count(repaired.begin(), repaired.end(), true));
}

/// Joints that changed, those that changed most first.
std::vector<const JointSummary*> changed_joints(const CleanReport& report) {
  std::vector<const JointSummary*> joints;
  for (const JointSummary& joint : report.joints) {
    if (joint.frames_changed > 0) joints.push_back(&joint);
  }
  std::stable_sort(joints.begin(), joints.end(), [](const auto* a, const auto* b) {
    return a->rms_change_deg > b->rms_change_deg;
  });
  return joints;
}

/// The middle one of the noises of the joints that changed and have one; 0 without any.
double typical_noise_deg(const CleanReport& report, std::size_t& joints) {
  std::vector<double> noises;
  for (const JointSummary& joint : report.joints) {
    if (joint.frames_changed > 0 && joint.noise_deg > 0) noises.push_back(joint.noise_deg);
  }
  joints = noises.size();
  if (noises.empty()) return 0;
  const auto middle = noises.begin() + static_cast<std::ptrdiff_t>(noises.size() / 2);
  std::nth_element(noises.begin(), middle, noises.end());
  return *middle;
}

double frames_per_second(const CleanReport& report) {
  return report.seconds > 0 ? static_cast<double>(report.frames) / report.seconds : 0;
}

std::string joint_table(const CleanReport& report, bool all_joints) {
  const std::vector<const JointSummary*> joints = changed_joints(report);
  if (joints.empty()) return "";
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right,
               Align::right});
  table.add({"joint", "noise deg", "change rms deg", "max deg", "frames repaired",
             "peak deg/s before", "after"});
  const std::size_t shown = all_joints ? joints.size() : std::min(joints.size(), short_list);
  for (std::size_t i = 0; i < shown; ++i) {
    const JointSummary& joint = *joints[i];
    table.add({printable(joint.name), joint.noise_deg > 0 ? figure(joint.noise_deg) : "-",
               figure(joint.rms_change_deg), figure(joint.max_change_deg),
               joint.frames_repaired > 0 ? grouped(joint.frames_repaired) : "-",
               figure(joint.peak_speed_before_deg_s), figure(joint.peak_speed_after_deg_s)});
  }
  std::string text = table.text();
  if (shown < joints.size())
    text += fmt::format("  and {} that changed less (--verbose lists them)\n",
                        counted(joints.size() - shown, "joint"));
  return text;
}

Json joint_json(const JointSummary& joint) {
  return {{"name", joint.name},
          {"noise_deg", joint.noise_deg},
          {"rms_change_deg", joint.rms_change_deg},
          {"max_change_deg", joint.max_change_deg},
          {"frames_changed", joint.frames_changed},
          {"frames_repaired", joint.frames_repaired},
          {"peak_speed_before_deg_s", joint.peak_speed_before_deg_s},
          {"peak_speed_after_deg_s", joint.peak_speed_after_deg_s},
          {"peak_frames", joint.peak_frames}};
}

/// The root position's changes are in file units, and its span says so by its keys.
Json span_json(const ReportSpan& span, const CleanReport& report) {
  const bool is_root = span.joint < 0;
  const std::string unit = is_root ? "" : "_deg";
  return {{"joint", is_root ? Json() : Json(report.joints[span.joint].name)},
          {"index", span.joint},
          {"first_frame", span.first_frame + 1},
          {"last_frame", span.last_frame + 1},
          {"action", to_string(span.action)},
          {"max_change" + unit, span.max_change},
          {"rms_change" + unit, span.rms_change}};
}

}  // namespace

std::string verdict(const CleanReport& report) {
  const std::size_t changed = count_changed(report);
  const std::size_t spikes = count_spans(report, Action::despiked);
  const std::size_t gaps = count_spans(report, Action::filled);
  if (changed == 0 && report.root_max_change == 0) return "clean: nothing changed";
  std::size_t noisy_joints = 0;
  const double noise_deg = typical_noise_deg(report, noisy_joints);
  std::vector<std::string> findings;
  if (noise_deg > 0) {
    findings.push_back(
        fmt::format("{} deg jitter on {}", figure(noise_deg), counted(noisy_joints, "joint")));
  } else if (changed > 0) {
    findings.push_back(counted(changed, "joint") + " changed");
  } else {
    findings.push_back("the root position changed");
  }
  if (spikes > 0) findings.push_back(counted(spikes, "spike"));
  if (gaps > 0) findings.push_back(counted(gaps, "gap"));
  const std::string all = fmt::format("{}", fmt::join(findings, ", "));
  if (noise_deg >= noticeable_deg) return "noisy: " + all;
  if (spikes + gaps > 0) return "damaged: " + all;
  return noise_deg > 0 ? "nearly clean: " + all : "smoothed: " + all;
}

std::string headline(const CleanJob& job, const CleanReport& report, const CleanPlan& plan,
                     const Colours& colours) {
  const std::string result = verdict(report);
  const bool is_good = result.compare(0, 5, "noisy") != 0 && result.compare(0, 7, "damaged") != 0;
  std::string line = fmt::format("{}: {}", printable(input_name(job.input)),
                                 colours.paint(is_good ? Paint::green : Paint::yellow, result));
  if (plan.dry_run) return line + "; nothing written (--dry-run)\n";
  if (job.output != "-") line += "; written to " + printable(job.output);
  return line + "\n";
}

std::string report_text(const CleanReport& report, bool all_joints) {
  std::string text = fmt::format("  {}, method {}",
                                 length_text(report.frames, report.frame_rate_hz), report.method);
  if (report.calibration_frames > 0) {
    text += fmt::format(
        "; the first {} a calibration pose and left alone",
        report.calibration_frames == 1 ? "is" : fmt::format("{} are", report.calibration_frames));
  }
  text += "\n";
  if (const std::string table = joint_table(report, all_joints); !table.empty())
    text += "\n" + table + "\n";
  if (report.root_max_change > 0) {
    text += fmt::format("  root position: change rms {}, max {} (file units)\n",
                        figure(report.root_rms_change), figure(report.root_max_change));
  }
  text += fmt::format("  {} of {} changed, {} repaired", count_changed(report),
                      counted(report.joints.size(), "joint"),
                      counted(frames_repaired(report), "frame"));
  if (report.seconds > 0)
    text +=
        fmt::format("; {} frames/s", grouped(static_cast<std::size_t>(frames_per_second(report))));
  return text + "\n";
}

Json report_json(const CleanJob& job, const CleanReport& report, const Diagnostics& diagnostics,
                 const CleanPlan& plan, bool with_spans) {
  Json json = {{"input", job.input},
               {"output", plan.dry_run ? Json() : Json(job.output)},
               {"verdict", verdict(report)},
               {"method", report.method},
               {"options", json_of(plan.options)},
               {"frames", report.frames},
               {"frame_rate_hz", report.frame_rate_hz},
               {"calibration_frames", report.calibration_frames},
               {"joints_changed", count_changed(report)},
               {"frames_repaired", frames_repaired(report)},
               {"spikes", count_spans(report, Action::despiked)},
               {"gaps", count_spans(report, Action::filled)},
               {"root_rms_change", report.root_rms_change},
               {"root_max_change", report.root_max_change},
               {"seconds", report.seconds},
               {"frames_per_second", frames_per_second(report)},
               {"warnings", report.warnings},
               {"diagnostics", json_of(diagnostics)}};
  json["joints"] = Json::array();
  for (const JointSummary& joint : report.joints) json["joints"].push_back(joint_json(joint));
  if (with_spans) {
    json["spans"] = Json::array();
    for (const ReportSpan& span : report.spans) json["spans"].push_back(span_json(span, report));
  }
  return json;
}

}  // namespace kinemend::cli
