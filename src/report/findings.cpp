// Lists the findings of any command in one form.
#include "report/figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace kinemend {

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

std::vector<ReportFinding> findings_of(const TakeFacts& /*take*/, const CompareOutcome& /*outcome*/,
                                       bool /*with_spans*/) {
  return {};
}

std::vector<ReportFinding> findings_of(const TakeFacts& /*take*/, const FeetReport& /*report*/,
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
