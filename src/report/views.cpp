// Gives figures, tracks, findings, verdict and text for the result of any command, in one form.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <type_traits>
#include <utility>

#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"
#include "report/figures.hpp"
#include "report/texts.hpp"

namespace kinemend {

namespace {

ReportFigure count_figure(std::string_view name, std::string_view label, std::size_t count) {
  return {std::string(name), std::string(label), static_cast<double>(count), true, ""};
}

std::vector<ReportFigure> figures(const TakeFacts& take, const CleanReport& report) {
  const bool is_joints = take.kind == TakeKind::joints;
  const auto of_root = [&](double value) {
    return is_joints ? std::optional<double>(value) : std::nullopt;
  };
  return {count_figure("tracks_changed", std::string(noun_of(take.kind)) + "s changed",
                       tracks_changed(report)),
          count_figure("frames_repaired", "frames repaired", frames_repaired(report)),
          count_figure("spikes", "spikes repaired", count_spans(report, Action::despiked)),
          count_figure("bursts", "bursts among them", count_bursts(report)),
          count_figure("gaps", "gaps filled", count_spans(report, Action::filled)),
          count_figure("gaps_refused", "gaps refused", report.fill.refused()),
          // Most files of joints cannot mark a sample as missing.
          {"gaps_left", "gaps left",
           is_joints ? std::nullopt : std::optional<double>(gaps_left(report)), true, ""},
          count_figure("swaps_undone", "swaps undone", report.swaps.size()),
          {"root_rms_change", "root position, change rms", of_root(report.root_rms_change), false,
           take.unit},
          {"root_max_change", "root position, largest change", of_root(report.root_max_change),
           false, take.unit},
          {"seconds", "time taken", report.seconds, false, "s"},
          {"frames_per_second", "speed", frames_per_second(report), false, "1/s"}};
}

std::vector<ReportFigure> figures(const TakeFacts& /*take*/, const CheckReport& report) {
  std::vector<ReportFigure> list;
  for (const CheckFigure& figure : check_figure_table()) {
    if (figure.rule.of_robot && !report.robot) continue;
    list.push_back({std::string(figure.rule.name), std::string(figure.rule.label),
                    figure.get(report.figures), figure.rule.is_count, unit_of(figure, report)});
  }
  return list;
}

std::vector<ReportFigure> figures(const TakeFacts& /*take*/, const FillOutcome& outcome) {
  return {count_figure("gaps", "gaps", outcome.report.gaps.size()),
          count_figure("filled", "filled", outcome.report.filled()),
          count_figure("refused", "refused", outcome.report.refused()),
          count_figure("unlabelled", "of unlabelled points", outcome.report.unlabelled),
          count_figure("not_within_range", "not within the range", outcome.not_within_range)};
}

std::vector<ReportFigure> figures(const TakeFacts& take, const CompareOutcome& outcome) {
  const std::size_t frames = outcome.markers ? outcome.markers->frames : outcome.comparison.frames;
  std::vector<ReportFigure> list = {count_figure("frames_compared", "frames compared", frames)};
  if (!outcome.markers)
    list.push_back({"psnr_peak", "peak of psnr_db", outcome.comparison.psnr_peak, false, "rad"});
  for_each_figure(outcome, [&](const FigureRule& rule, const std::optional<double>& value) {
    list.push_back(
        {std::string(rule.name), std::string(rule.label), value, false, unit_of(rule, take)});
  });
  return list;
}

std::vector<ReportFigure> figures(const TakeFacts& /*take*/, const FeetReport& report) {
  return {count_figure("contacts", "contacts", report.contacts.size()),
          count_figure("held", "held", contacts_held(report))};
}

// Returns a column of one member of every row.
template <class Row, class Member>
ReportColumn column(std::string name, std::string label, const std::vector<Row>& rows,
                    Member Row::*member) {
  ReportColumn result{std::move(name), std::move(label), !std::is_floating_point_v<Member>, {}};
  result.values.reserve(rows.size());
  for (const Row& row : rows) result.values.push_back(static_cast<double>(row.*member));
  return result;
}

template <class Row>
std::vector<std::string> names_of(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  names.reserve(rows.size());
  for (const Row& row : rows) names.push_back(row.name);
  return names;
}

ReportTracks tracks(const TakeFacts& take, const CleanReport& report) {
  using Row = TrackSummary;
  std::vector<Row> rows = report.tracks;
  std::erase_if(rows, [](const Row& row) { return !row.is_position; });
  ReportTracks result{
      report.unit,
      names_of(rows),
      {column("noise", "noise", rows, &Row::noise),
       column("rms_change", "change rms", rows, &Row::rms_change),
       column("max_change", "largest change", rows, &Row::max_change),
       column("frames_changed", "frames changed", rows, &Row::frames_changed),
       column("frames_repaired", "frames repaired", rows, &Row::frames_repaired),
       column("peak_speed_before", "peak speed before", rows, &Row::peak_speed_before),
       column("peak_speed_after", "after", rows, &Row::peak_speed_after),
       column("peak_frames", "frames of a peak", rows, &Row::peak_frames)}};
  if (std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.left > 0; })) {
    result.columns.push_back(
        column("expected_noise", "noise expected", rows, &Row::expected_noise));
    result.columns.push_back(column("left", "expected to be left", rows, &Row::left));
  }
  if (take.kind == TakeKind::markers) {
    result.columns.push_back(column("gaps_left", "gaps left", rows, &Row::gaps_left));
    result.columns.push_back(
        column("frames_missing", "frames missing", rows, &Row::frames_missing));
  }
  return result;
}

ReportTracks tracks(const TakeFacts& /*take*/, const CheckReport& report) {
  using Row = TrackHealth;
  const std::vector<Row>& rows = report.tracks;
  ReportTracks result{
      report.noise_unit,
      names_of(rows),
      {column("gaps", "gaps", rows, &Row::gaps),
       column("longest_gap", "longest gap, frames", rows, &Row::longest_gap),
       column("missing_frames", "frames missing", rows, &Row::missing_frames),
       column("spikes", "spikes", rows, &Row::spikes),
       column("frozen", "frozen", rows, &Row::frozen),
       column("bridged", "bridged", rows, &Row::bridged),
       column("swaps", "swaps", rows, &Row::swaps), column("flips", "flips", rows, &Row::flips),
       column("noise", "noise", rows, &Row::noise)}};
  if (report.robot && !report.is_markers) {
    result.columns.push_back(
        column("peak_speed_deg_s", "peak speed, deg/s", rows, &Row::peak_speed_deg_s));
    result.columns.push_back(column("peak_acceleration_deg_s2", "peak acceleration, deg/s2", rows,
                                    &Row::peak_acceleration_deg_s2));
  }
  return result;
}

ReportTracks tracks_of_markers(const TakeFacts& take, const MarkerComparison& comparison) {
  using Row = MarkerErrors;
  const std::vector<Row>& rows = comparison.markers;
  ReportTracks result{take.unit,
                      comparison.names,
                      {column("samples", "samples", rows, &Row::samples),
                       column("rms_distance", "rms distance", rows, &Row::rms_distance),
                       column("max_distance", "largest", rows, &Row::max_distance),
                       column("rms_axis", "rms along an axis", rows, &Row::rms),
                       column("velocity_rms", "velocity, a second", rows, &Row::velocity_rms),
                       {"above_6_hz", "above 6 Hz", false, {}}}};
  for (const Row& row : rows)
    result.columns.back().values.push_back(
        row.above_6_hz.value_or(std::numeric_limits<double>::quiet_NaN()));
  return result;
}

ReportTracks tracks(const TakeFacts& take, const CompareOutcome& outcome) {
  if (outcome.markers) return tracks_of_markers(take, *outcome.markers);
  using Row = JointComparison;
  const std::vector<Row>& rows = outcome.comparison.joints;
  return {"deg",
          take.tracks,
          {column("geodesic_rms_deg", "rms", rows, &Row::geodesic_rms_deg),
           column("geodesic_max_deg", "largest", rows, &Row::geodesic_max_deg),
           column("peak_speed_reference_deg_s", "peak speed of the reference", rows,
                  &Row::peak_speed_reference_deg_s),
           column("peak_speed_other_deg_s", "of the other", rows, &Row::peak_speed_other_deg_s),
           column("peak_frames", "frames of a peak", rows, &Row::peak_frames)}};
}

template <class Result>
ReportTracks tracks(const TakeFacts& /*take*/, const Result& /*result*/) {
  return {};
}

std::string verdict(const TakeFacts& take, const CleanReport& report) {
  return clean_verdict(take, report);
}
std::string verdict(const TakeFacts& take, const CheckReport& report) {
  return take.contents.empty() ? check_verdict(report) : take.contents + ": nothing to check";
}
std::string verdict(const TakeFacts& take, const FillOutcome& outcome) {
  return take.contents.empty() ? fill_verdict(outcome) : take.contents + ": nothing to fill";
}
std::string verdict(const TakeFacts& /*take*/, const CompareOutcome& /*outcome*/) { return ""; }
std::string verdict(const TakeFacts& /*take*/, const FeetReport& report) {
  return fmt::format("{}, {:.1f} s; held for {:.1f} s", counted(report.contacts.size(), "contact"),
                     report.time.found_s, report.time.held_s);
}

}  // namespace

std::string verdict_of(const Report& report) {
  return std::visit([&](const auto& result) { return verdict(report.take, result); },
                    report.result);
}

std::vector<ReportFigure> figures_of(const Report& report) {
  return std::visit([&](const auto& result) { return figures(report.take, result); },
                    report.result);
}

ReportTracks tracks_of(const Report& report) {
  return std::visit([&](const auto& result) { return tracks(report.take, result); }, report.result);
}

std::string to_text(const Report& report, const TextOptions& options) {
  return std::visit([&](const auto& result) { return result_text(report.take, result, options); },
                    report.result);
}

namespace {

// Returns the kind of fault that an action repaired.
FindingKind kind_of(Action action) {
  switch (action) {
    case Action::despiked:
      return FindingKind::spike;
    case Action::filled:
    case Action::refused:
      return FindingKind::gap;
    case Action::foot_adjusted:
      return FindingKind::slide;
    case Action::kept:
    case Action::denoised:
      break;
  }
  return FindingKind::noise;
}

// Returns a finding in a span of frames.
ReportFinding finding_of(FindingKind kind, std::string_view verdict, std::string track,
                         std::size_t first_frame, std::size_t last_frame) {
  ReportFinding finding;
  finding.kind = to_string(kind);
  finding.verdict = verdict;
  finding.track = std::move(track);
  finding.first_frame = first_frame;
  finding.last_frame = last_frame;
  return finding;
}

ReportFinding finding_of(const TakeFacts& take, const GapOutcome& outcome) {
  const Gap& gap = outcome.gap;
  ReportFinding finding = finding_of(FindingKind::gap, outcome.filled ? "filled" : "refused",
                                     take.tracks[gap.track], gap.first_frame, gap.last_frame);
  finding.quantity = quantity_of(take, outcome);
  finding.unit = unit_of(take, outcome);
  finding.method = outcome.method;
  finding.reason = outcome.reason;
  return finding;
}

ReportFinding finding_of(const TakeFacts& take, const ReportSpan& span) {
  // The root position belongs to joint 0.
  const bool is_root = span.joint < 0;
  const bool is_rotation = take.kind == TakeKind::joints && !is_root;
  ReportFinding finding =
      finding_of(kind_of(span.action), to_string(span.action),
                 take.tracks[is_root ? 0 : static_cast<std::size_t>(span.joint)], span.first_frame,
                 span.last_frame);
  finding.quantity = is_rotation ? "rotation" : "position";
  finding.amount = span.max_change;
  finding.rms = span.rms_change;
  finding.unit = is_rotation ? "deg" : take.unit;
  return finding;
}

// Noise affects a whole track, as in `check`: the smoothed frames are one span, from the first to
// the last, regardless of repairs between them.
std::vector<ReportSpan> with_noise_merged(const std::vector<ReportSpan>& spans) {
  struct Noise {
    std::size_t place = 0;
    double squares = 0, frames = 0;
  };
  std::vector<ReportSpan> merged;
  std::map<std::int32_t, Noise> noises;
  for (const ReportSpan& span : spans) {
    if (span.action != Action::denoised) {
      merged.push_back(span);
      continue;
    }
    const auto [found, is_new] = noises.emplace(span.joint, Noise{merged.size()});
    if (is_new) merged.push_back(span);
    Noise& noise = found->second;
    ReportSpan& whole = merged[noise.place];
    const auto frames = static_cast<double>(span.last_frame - span.first_frame + 1);
    noise.squares += frames * span.rms_change * span.rms_change;
    noise.frames += frames;
    whole.last_frame = span.last_frame;
    whole.max_change = std::max(whole.max_change, span.max_change);
    whole.rms_change = std::sqrt(noise.squares / noise.frames);
  }
  return merged;
}

std::vector<ReportFinding> findings_of(const TakeFacts& take, const CleanReport& report,
                                       bool with_spans) {
  std::vector<ReportFinding> findings;
  for (const MarkerSwap& swap : report.swaps) {
    findings.push_back(
        finding_of(FindingKind::swap, "undone",
                   take.tracks[swap.first_marker] + ", " + take.tracks[swap.second_marker],
                   swap.first_frame, swap.last_frame));
  }
  // A filled gap is also a span of changed samples; both are one finding.
  using Key = std::tuple<std::string, std::string, std::size_t, std::size_t>;
  std::map<Key, std::size_t> filled;
  for (const GapOutcome& gap : report.fill.gaps) {
    findings.push_back(finding_of(take, gap));
    const ReportFinding& added = findings.back();
    if (gap.filled) {
      filled.emplace(Key(added.track, added.quantity, added.first_frame, added.last_frame),
                     findings.size() - 1);
    }
  }
  if (!with_spans) return findings;
  for (const ReportSpan& span : with_noise_merged(report.spans)) {
    ReportFinding finding = finding_of(take, span);
    const auto found = span.action != Action::filled
                           ? filled.end()
                           : filled.find(Key(finding.track, finding.quantity, finding.first_frame,
                                             finding.last_frame));
    if (found == filled.end()) {
      findings.push_back(std::move(finding));
    } else {
      findings[found->second].amount = finding.amount;
      findings[found->second].rms = finding.rms;
    }
  }
  return findings;
}

std::vector<ReportFinding> findings_of(const TakeFacts& take, const FillOutcome& outcome,
                                       bool /*with_spans*/) {
  std::vector<ReportFinding> findings;
  for (const GapOutcome& gap : outcome.report.gaps) {
    findings.push_back(finding_of(take, gap));
    if (gap.expected_error > 0) findings.back().amount = gap.expected_error;
  }
  return findings;
}

std::vector<ReportFinding> findings_of(const TakeFacts& /*take*/, const CheckReport& report,
                                       bool /*with_spans*/) {
  std::vector<ReportFinding> findings;
  for (const Finding& found : report.findings) {
    findings.push_back(finding_of(found.kind, to_string(found.severity), found.track,
                                  found.first_frame, found.last_frame));
    findings.back().amount = found.figure;
    findings.back().unit = found.unit;
    findings.back().reason = found.words;
  }
  return findings;
}

template <class Result>
std::vector<ReportFinding> findings_of(const TakeFacts& /*take*/, const Result& /*result*/,
                                       bool /*with_spans*/) {
  return {};
}

}  // namespace

std::string_view quantity_of(const TakeFacts& take, const GapOutcome& gap) {
  return take.kind == TakeKind::joints && !gap.is_position ? "rotation" : "position";
}

std::string unit_of(const TakeFacts& take, const GapOutcome& gap) {
  return quantity_of(take, gap) == "rotation" ? "deg" : take.unit;
}

std::vector<ReportFinding> findings_of(const Report& report, bool with_spans) {
  return std::visit(
      [&](const auto& result) { return findings_of(report.take, result, with_spans); },
      report.result);
}

}  // namespace kinemend
