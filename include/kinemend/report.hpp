// The result of any command as figures, findings and tracks in one form, and as JSON and text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinemend/check.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend {

/// Name and version of the JSON; docs/report.md describes it and docs/report.schema.json defines
/// it.
inline constexpr std::string_view report_schema = "kinemend.report/1";

/// The facts about the take itself in a report.
struct TakeFacts {
  std::string input;      ///< the path as given; "-" is standard input
  std::string output;     ///< path of the result; empty if nothing was written
  std::string animation;  ///< name of the take in a file that holds several; else empty
  TakeKind kind = TakeKind::joints;
  std::string format;               ///< "bvh"
  std::string unit;                 ///< unit of lengths; empty if the file does not state it
  double metres_per_unit = 0;       ///< 0 if the file does not state it
  std::vector<std::string> tracks;  ///< names of all joints or markers
  std::size_t frames = 0;
  std::int64_t first_frame = 1;  ///< the number that the file gives to the first frame
  double frame_rate_hz = 0;
  /// The contents of a marker file without markers: "4,564 analog frames, no points"; else empty.
  std::string contents;
  Diagnostics diagnostics;  ///< the reader's repairs
};
/// Returns the facts except `input`, `output` and `diagnostics`, which a take does not contain.
TakeFacts take_facts(const Take& take);
/// Returns `TakeFacts::contents`.
std::string contents_without_markers(const Take& clip);

/// The result of `fill`.
struct FillOutcome {
  FillReport report;
  std::size_t not_within_range = 0;  ///< gaps outside `FillSettings::range`
};
/// The result of `compare`. `Report::take` is the take that is compared with the reference.
struct CompareOutcome {
  std::string reference;  ///< path of the reference as given
  Comparison comparison;  ///< comparison of joints
  /// Comparison of markers, which replaces `comparison`.
  std::optional<MarkerComparison> markers{};
  MarkerFit fit = MarkerFit::none;  ///< fit of the reference to the other take; markers only
};
/// "none", "rigid", "gain-offset".
std::string_view to_string(MarkerFit fit);

/// One take and the result of a command. `CleanReport` is that of `clean`, `FeetReport` is the
/// result of `contacts`.
struct Report {
  TakeFacts take;
  std::variant<CleanReport, CheckReport, FillOutcome, CompareOutcome, FeetReport> result;
};

/// "noisy: 1.5 deg jitter on 31 joints, 52 spikes", "1 serious, 2 warnings", "3 gaps: 2 filled, 1
/// refused"; empty for a comparison.
std::string verdict_of(const Report& report);

/// A number about the whole take.
struct ReportFigure {
  std::string name;             ///< for programs: "longest_gap_s"
  std::string label;            ///< for people: "longest gap"
  std::optional<double> value;  ///< empty if the take does not have it
  bool is_count = false;
  std::string unit;  ///< "deg", "mm"; empty for counts and unknown units
};
std::vector<ReportFigure> figures_of(const Report& report);

/// A span in which a track has a fault, and how the fault was treated. `check` and `clean` count in
/// the same way: a spike is a run of frames, and noise is one finding for each track.
struct ReportFinding {
  /// As `to_string(FindingKind)`, for every command: "noise" was smoothed, "spike" repaired, "gap"
  /// filled or refused, "slide" held.
  std::string kind;
  /// For `check` the severity, else the treatment: "denoised", "despiked", "filled",
  /// "foot_adjusted", "refused", "undone".
  std::string verdict;
  std::string track;     ///< joint or marker; "A, B" for two; empty for the whole take
  std::string quantity;  ///< "rotation", "position" or empty
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;    ///< inclusive, counted from 0
  std::optional<double> amount;  ///< the largest change, or the size of the fault
  std::optional<double> rms;     ///< root mean square of the change over the frames
  std::string unit;              ///< unit of `amount` and `rms`
  std::string method;            ///< the method that filled or refused the gap
  std::string reason;            ///< in words
};
/// Returns the findings of a report: worst first for `check`, else by track, then frame.
/// `with_spans` includes the spans that `clean` smoothed and repaired.
std::vector<ReportFinding> findings_of(const Report& report, bool with_spans = true);

/// One figure of every track.
struct ReportColumn {
  std::string name;   ///< for programs: "rms_change"
  std::string label;  ///< for people: "change rms"
  bool is_count = false;
  std::vector<double> values;  ///< one value per track
};
struct ReportTracks {
  std::string unit;  ///< unit of figures whose name states none: "deg" for joints, else the unit of
                     ///< the markers
  std::vector<std::string> names;
  std::vector<ReportColumn> columns;
};
/// Returns the figures of each track; empty for a command without such figures. Points that are
/// angles or forces are left out.
ReportTracks tracks_of(const Report& report);

/// A figure of `check` or `compare` (figures of joints first) that can have a limit.
struct FigureRule {
  std::string_view name;   ///< as in `ReportFigure`
  std::string_view label;  ///< for people
  std::string_view unit;   ///< empty: a count, or the unit of the tracks
  std::string_view limit;  ///< name of the limit: "max_gap_s"
  bool is_count = false;
  bool more_is_better = false;  ///< the limit is a minimum
  bool of_robot = false;        ///< known only with `CheckSettings::robot`
};
std::span<const FigureRule> check_figures();
std::span<const FigureRule> comparison_figures();

struct FigureLimit {
  std::string_view figure;  ///< its name
  double value = 0;
};
/// Returns a line for each limit that is exceeded, for `check` with the worst finding. A figure
/// that the take does not have exceeds no limit of `check` and every limit of `compare`.
std::vector<std::string> passed_limits(const Report& report, std::span<const FigureLimit> limits);

struct TextOptions {
  bool details = true;   ///< for `clean`: print the lines after the first
  bool all = false;      ///< print every row, not only the first few of each kind
  bool colours = false;  ///< escape codes for a terminal
};
/// Returns lines for people. A shortened list ends with a hint to use --verbose.
std::string to_text(const Report& report, const TextOptions& options = {});

/// Returns the entry of one take in the document, indented by two spaces. A figure that is not
/// finite is null; bytes that are not UTF-8 are replaced. `with_spans`: as for `findings_of`.
std::string to_json(const Report& report, bool with_spans = true);
/// Returns the entry of a take that failed.
std::string failure_json(std::string_view input, std::string_view error, int exit_code);
/// Returns the whole document of a command; `takes` are its entries in order.
std::string report_document(std::string_view command, std::span<const std::string> takes);
/// Returns the list `diagnostics` of an entry. Positions are bytes in binary formats, else lines.
std::string diagnostics_json(const Diagnostics& diagnostics, std::string_view format);

/// "walk.bvh:12: ...", or "walk.c3d: byte 12: ..." for a format whose positions are bytes.
std::string diagnostic_line(const SourceInfo& source, const Diagnostic& diagnostic);
/// Returns `diagnostic_line` without the name of the take: "line 12: ...", "byte 12: ...".
std::string diagnostic_text(std::string_view format, const Diagnostic& diagnostic);

}  // namespace kinemend
