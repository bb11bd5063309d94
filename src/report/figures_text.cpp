// Writes the results of `check` and `compare` as text: figures, findings, and rows for each track.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "report/figures.hpp"
#include "report/texts.hpp"

namespace kinemend {

std::string with_unit(double value, std::string_view unit) {
  if (unit == "m") return measure_text(value, unit);
  const std::string text = value == std::floor(value) && value < 1e15
                               ? grouped(static_cast<std::size_t>(value))
                               : figure(value);
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

namespace {

std::string frames_text(const Finding& finding, const TakeFacts& take, const CheckReport& report) {
  if (finding.first_frame == finding.last_frame)
    return fmt::format("frame {}", frame_number(finding.first_frame, take.first_frame));
  if (finding.last_frame - finding.first_frame + 1 + report.calibration_frames >= report.frames)
    return "throughout";
  return fmt::format("frames {}-{}", frame_number(finding.first_frame, take.first_frame),
                     frame_number(finding.last_frame, take.first_frame));
}

std::string dashes_to_spaces(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

std::string finding_sentence(const Finding& finding, const TakeFacts& take,
                             const CheckReport& report) {
  // In "Frame 1 is a calibration pose" the frames are the subject.
  if (finding.kind == FindingKind::calibration)
    return frames_text(finding, take, report) + " " + printable(finding.words);
  std::string text = frames_text(finding, take, report) + ": ";
  if (!finding.track.empty()) text += printable_name(finding.track) + " ";
  text += printable(finding.words);
  if (finding.figure != 0) text += fmt::format(" ({})", with_unit(finding.figure, finding.unit));
  return text;
}

namespace {

TakeKind kind_checked(const CheckReport& report) {
  return report.is_markers ? TakeKind::markers : TakeKind::joints;
}

// Returns the number of findings that are a fault.
std::size_t faults_in(const CheckReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.findings.begin(), report.findings.end(),
                    [](const Finding& finding) { return finding.severity != Severity::note; }));
}

// Whether the take may have errors that are not visible.
bool is_doubtful(const CheckReport& report) {
  return std::any_of(report.findings.begin(), report.findings.end(), [](const Finding& finding) {
    return finding.kind == FindingKind::no_contact || finding.kind == FindingKind::expected_noise;
  });
}

}  // namespace

std::string check_verdict(const CheckReport& report) {
  const std::size_t faults = faults_in(report);
  if (faults == 0 && is_doubtful(report))
    return "no fault found, but the take is probably noisy: see the notes";
  if (faults == 0)
    return "no fault found; slow errors (video, depth cameras, suits) cannot be seen in a "
           "take alone";
  const auto serious = static_cast<std::size_t>(
      std::count_if(report.findings.begin(), report.findings.end(),
                    [](const Finding& finding) { return finding.severity == Severity::serious; }));
  return fmt::format("{} serious, {}", grouped(serious), counted(faults - serious, "warning"));
}

namespace {

// Returns when feet stand, and how that differs from the loads of force plates.
std::vector<std::pair<std::string, std::string>> stand_rows(const CheckReport& report) {
  const FootStands& stands = report.stands;
  if (stands.sides.empty()) return {};
  std::vector<std::pair<std::string, std::string>> rows = {
      {"feet stand", stand_words(stands.time)}};
  if (report.plate_stands.empty()) return rows;
  const PlateFigures plates = plate_figures(report.plate_stands);
  std::string words = fmt::format("{} of one foot, {} with a stand", counted(plates.loads, "load"),
                                  grouped(plates.found));
  const auto add = [&](const std::optional<double>& ms, const char* name) {
    if (ms) words += fmt::format("; {} {} ms apart in the median", name, figure(*ms));
  };
  add(plates.onset_ms, "onset");
  add(plates.offset_ms, "offset");
  rows.emplace_back("force plates", words);
  return rows;
}

// Lists the first few of each kind: a hundred spikes say no more than five.
std::string findings_text(const TakeFacts& take, const CheckReport& report, bool all) {
  // Chosen by hand.
  constexpr std::size_t most_of_a_kind = 5;
  std::map<FindingKind, std::size_t> shown;
  std::string text;
  std::size_t left_out = 0;
  Table table({Align::left, Align::left, Align::left});
  for (const Finding& finding : report.findings) {
    if (!all && ++shown[finding.kind] > most_of_a_kind) {
      ++left_out;
      continue;
    }
    table.add({std::string(to_string(finding.severity)), dashes_to_spaces(to_string(finding.kind)),
               finding_sentence(finding, take, report)});
  }
  if (!table.empty()) text += "\n" + table.text();
  if (left_out > 0)
    text += fmt::format("  and {} more of these kinds (--verbose lists them)\n", grouped(left_out));
  return text;
}

std::string tracks_text(const CheckReport& report) {
  const ShownUnit shown = shown_unit(report.noise_unit);
  const bool with_rates = report.robot && !report.is_markers;
  std::vector<Align> columns(with_rates ? 10 : 8, Align::right);
  columns.front() = Align::left;
  Table table(columns);
  std::vector<std::string> heading = {noun_of(kind_checked(report)),
                                      "gaps",
                                      "frames missing",
                                      "longest",
                                      "spikes",
                                      "frozen or bridged",
                                      report.is_markers ? "swaps" : "flips",
                                      report.noise_unit.empty() ? "noise" : "noise " + shown.name};
  if (with_rates) heading.insert(heading.end(), {"peak deg/s", "peak deg/s2"});
  table.add(heading);
  for (const TrackHealth& track : report.tracks) {
    std::vector<std::string> row = {printable_name(track.name),
                                    grouped(track.gaps),
                                    grouped(track.missing_frames),
                                    grouped(track.longest_gap),
                                    grouped(track.spikes),
                                    grouped(track.frozen + track.bridged),
                                    grouped(report.is_markers ? track.swaps : track.flips),
                                    figure(shown.factor * track.noise)};
    if (with_rates) {
      row.insert(row.end(),
                 {figure(track.peak_speed_deg_s), figure(track.peak_acceleration_deg_s2)});
    }
    table.add(row);
  }
  return "\n" + table.text();
}

// Lists slide and depth of the feet of each of several people.
std::string subjects_text(const CheckReport& report) {
  if (report.subjects.empty()) return "";
  const auto length = [](const std::optional<double>& value) {
    return value ? figure(*value) : "-";
  };
  Table table({Align::left, Align::right, Align::right, Align::right});
  table.add({"subject", "markers", "slide cm", "depth cm"});
  for (const SubjectHealth& subject : report.subjects) {
    table.add({subject.name.empty() ? "(none)" : printable_name(subject.name),
               grouped(subject.markers), length(subject.slide_cm), length(subject.sink_cm)});
  }
  return "\n" + table.text();
}

}  // namespace

std::string result_text(const TakeFacts& take, const CheckReport& report,
                        const TextOptions& options) {
  const std::string name = painted(Paint::bold, shown_name(take), options.colours);
  if (!take.contents.empty()) {
    return fmt::format("{}: {}: nothing to check\n", name, take.contents);
  }
  std::string text = fmt::format("{}: {}\n  {}, {}\n\n", name, check_verdict(report),
                                 length_text(report.frames, report.frame_rate_hz),
                                 counted(report.tracks.size(), noun_of(kind_checked(report))));
  Table table({Align::left, Align::left});
  for (const CheckFigure& entry : check_figure_table()) {
    const std::optional<double> value = entry.get(report.figures);
    const bool of_markers = entry.rule.name == "swaps", of_joints = entry.rule.name == "flips";
    // A take whose feet slide most may have no contact that is found, so this row never disappears.
    if (!value && entry.rule.name == "slide_cm")
      table.add({std::string(entry.rule.label), "no contacts found"});
    if (!value || (report.is_markers ? of_joints : of_markers)) continue;
    table.add({std::string(entry.rule.label), with_unit(*value, unit_of(entry, report))});
  }
  for (const auto& [label, words] : stand_rows(report)) table.add({label, words});
  for (const NoiseCharacter& noise : report.noise) {
    table.add({"noise found",
               noise_words(noise, kind_checked(report), report.noise_unit, report.frame_rate_hz)});
  }
  table.add({"source", source_words(report.source)});
  for (const Diagnostic& entry : take.diagnostics.entries())
    table.add({"repaired", printable(diagnostic_text(take.format, entry))});
  if (faults_in(report) == 0 && !is_doubtful(report))
    table.add({"looked for",
               "all of the above, lengths, feet, rate and unit; if the take comes from video, a "
               "depth camera or a suit, try: kinemend clean --source video"});
  text += table.text() + subjects_text(report) + findings_text(take, report, options.all);
  if (options.all) text += tracks_text(report);
  return text;
}

namespace {

std::string exact(double value) {
  return std::isinf(value) ? "equal" : fmt::format("{:.4g}", value);
}

std::string figures_text(const TakeFacts& take, const CompareOutcome& outcome) {
  Table table({Align::left, Align::right, Align::left, Align::left});
  for_each_figure(outcome, [&](const FigureRule& rule, const std::optional<double>& value) {
    table.add({std::string(rule.name), value ? exact(*value) : "-",
               value ? unit_of(rule, take) : "", std::string(rule.label)});
  });
  return table.text();
}

std::string joints_text(const TakeFacts& take, const Comparison& comparison) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right});
  table.add({"joint", "rms deg", "max deg", "peak deg/s reference", "other"});
  for (std::size_t j = 0; j < comparison.joints.size(); ++j) {
    const JointComparison& joint = comparison.joints[j];
    table.add({printable_name(take.tracks[j]), figure(joint.geodesic_rms_deg),
               figure(joint.geodesic_max_deg), figure(joint.peak_speed_reference_deg_s),
               figure(joint.peak_speed_other_deg_s)});
  }
  return table.text();
}

std::string markers_text(const TakeFacts& take, const MarkerComparison& comparison) {
  const std::string unit = take.unit.empty() ? "units" : take.unit;
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right});
  table.add({"marker", "samples", "rms distance " + unit, "max", "velocity rms " + unit + "/s",
             "above 6 Hz " + unit});
  for (std::size_t m = 0; m < comparison.markers.size(); ++m) {
    const MarkerErrors& row = comparison.markers[m];
    table.add({printable_name(comparison.names[m]), grouped(row.samples), figure(row.rms_distance),
               figure(row.max_distance), figure(row.velocity_rms),
               row.above_6_hz ? figure(*row.above_6_hz) : "-"});
  }
  return table.text();
}

// Describes the compared frames and markers.
std::string pairing_text(const CompareOutcome& outcome) {
  const MarkerComparison& comparison = *outcome.markers;
  std::string text = fmt::format("  {} and {} compared", counted(comparison.frames, "frame"),
                                 counted(comparison.names.size(), "marker"));
  if (outcome.fit == MarkerFit::rigid) text += ", the reference fitted by one turn and one shift";
  if (outcome.fit == MarkerFit::gain_offset) text += ", each channel with its own gain and offset";
  if (!comparison.unmatched.empty())
    text += fmt::format("; unmatched: {}", fmt::join(comparison.unmatched, ", "));
  return text;
}

}  // namespace

std::string result_text(const TakeFacts& take, const CompareOutcome& outcome,
                        const TextOptions& options) {
  const std::string compared =
      outcome.markers ? pairing_text(outcome)
                      : fmt::format("  {} compared", counted(outcome.comparison.frames, "frame"));
  std::string text = compared + "\n\n" + figures_text(take, outcome);
  if (!options.all) return text;
  return text + "\n" +
         (outcome.markers ? markers_text(take, *outcome.markers)
                          : joints_text(take, outcome.comparison));
}

}  // namespace kinemend
