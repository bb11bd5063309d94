// kinemend check: what is wrong with a take, before anything is cleaned.

#include "kinemend/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <variant>

#include "commands.hpp"
#include "json.hpp"
#include "kinemend/error.hpp"
#include "kinemend/frame_numbers.hpp"
#include "kinemend/io.hpp"
#include "kinemend/version.hpp"
#include "table.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

struct Checked {
  std::string name;
  CheckReport report;
  Diagnostics diagnostics;
  std::string contents;  ///< of a file without markers
  std::int64_t first_frame = 1;
  SourceInfo source;
};

/// One figure, defined once for table, JSON and limit.
struct Figure {
  std::string name;   ///< as in JSON
  std::string label;  ///< in the table
  std::string limit;  ///< the flag
  std::string unit;   ///< "noise": that of the take's noise
  std::vector<FindingKind> kinds;
  std::optional<double> (*get)(const CheckFigures& figures);
};

using Value = std::optional<double>;

const std::vector<Figure>& figures() {
  static const std::vector<Figure> table = {
      {"gaps",
       "gaps",
       "max_gaps",
       "",
       {FindingKind::gap},
       [](const CheckFigures& f) -> Value { return static_cast<double>(f.gaps); }},
      {"longest_gap_s",
       "longest gap",
       "max_gap_s",
       "s",
       {FindingKind::gap},
       [](const CheckFigures& f) -> Value { return f.longest_gap_s; }},
      {"missing_percent",
       "samples missing",
       "max_missing",
       "%",
       {FindingKind::gap},
       [](const CheckFigures& f) -> Value { return f.missing_percent; }},
      {"swaps",
       "swapped markers",
       "max_swaps",
       "",
       {FindingKind::swap},
       [](const CheckFigures& f) -> Value { return static_cast<double>(f.swaps); }},
      {"spikes",
       "spikes",
       "max_spikes",
       "",
       {FindingKind::spike},
       [](const CheckFigures& f) -> Value { return static_cast<double>(f.spikes); }},
      {"frozen",
       "frozen or bridged spans",
       "max_frozen",
       "",
       {FindingKind::frozen, FindingKind::bridged},
       [](const CheckFigures& f) -> Value { return static_cast<double>(f.frozen); }},
      {"worst_noise",
       "noise of the worst track",
       "max_noise",
       "noise",
       {FindingKind::noise},
       [](const CheckFigures& f) -> Value { return f.worst_noise; }},
      {"length_change_percent",
       "change of a length",
       "max_length_change",
       "%",
       {FindingKind::length},
       [](const CheckFigures& f) -> Value { return f.length_change_percent; }},
      {"slide_cm",
       "slide of a standing foot",
       "max_slide_cm",
       "cm",
       {FindingKind::slide},
       [](const CheckFigures& f) -> Value { return f.slide_cm; }},
      {"sink_cm",
       "depth below the floor",
       "max_sink_cm",
       "cm",
       {FindingKind::sink},
       [](const CheckFigures& f) -> Value { return f.sink_cm; }},
      {"flips",
       "Euler flips",
       "max_flips",
       "",
       {FindingKind::euler_flip},
       [](const CheckFigures& f) -> Value { return static_cast<double>(f.flips); }}};
  return table;
}

std::string unit_of(const Figure& entry, const CheckReport& report) {
  return entry.unit == "noise" ? report.noise_unit : entry.unit;
}

std::string with_unit(double value, std::string_view unit) {
  const std::string text = value == std::floor(value) && value < 1e15
                               ? grouped(static_cast<std::size_t>(value))
                               : cli::figure(value);
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

std::string frames_text(const Finding& finding, const Checked& take) {
  const CheckReport& report = take.report;
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

std::string finding_sentence(const Finding& finding, const Checked& take) {
  std::string text = frames_text(finding, take) + ": ";
  if (!finding.track.empty()) text += printable(finding.track) + " ";
  text += printable(finding.words);
  const bool says_all = finding.figure == 0 || finding.kind == FindingKind::calibration;
  if (!says_all) text += fmt::format(" ({})", with_unit(finding.figure, finding.unit));
  return text;
}

std::string summary_text(const CheckReport& report) {
  std::size_t counts[3] = {};
  for (const Finding& finding : report.findings)
    ++counts[static_cast<std::size_t>(finding.severity)];
  if (counts[1] + counts[2] == 0) return "nothing wrong";
  return fmt::format("{} serious, {}", grouped(counts[2]), counted(counts[1], "warning"));
}

// The first few of each kind: a hundred spikes say no more than five.
std::string findings_text(const Checked& take, bool all) {
  const CheckReport& report = take.report;
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
               finding_sentence(finding, take)});
  }
  if (!table.empty()) text += "\n" + table.text();
  if (left_out > 0)
    text += fmt::format("  and {} more of these kinds (--verbose lists them)\n", grouped(left_out));
  return text;
}

std::string tracks_text(const CheckReport& report) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right,
               Align::right, Align::right});
  table.add({report.is_markers ? "marker" : "joint", "gaps", "frames missing", "longest", "spikes",
             "frozen or bridged", report.is_markers ? "swaps" : "flips",
             report.noise_unit.empty() ? "noise" : "noise " + report.noise_unit});
  for (const TrackHealth& track : report.tracks) {
    table.add({printable(track.name), grouped(track.gaps), grouped(track.missing_frames),
               grouped(track.longest_gap), grouped(track.spikes),
               grouped(track.frozen + track.bridged),
               grouped(report.is_markers ? track.swaps : track.flips), cli::figure(track.noise)});
  }
  return "\n" + table.text();
}

/// Of several people what the feet of each do.
std::string subjects_text(const CheckReport& report) {
  if (report.subjects.empty()) return "";
  const auto length = [](const Value& value) { return value ? cli::figure(*value) : "-"; };
  Table table({Align::left, Align::right, Align::right, Align::right});
  table.add({"subject", "markers", "slide cm", "depth cm"});
  for (const SubjectHealth& subject : report.subjects) {
    table.add({subject.name.empty() ? "(none)" : printable(subject.name), grouped(subject.markers),
               length(subject.slide_cm), length(subject.sink_cm)});
  }
  return "\n" + table.text();
}

std::string take_text(const Checked& take, bool verbose) {
  const CheckReport& report = take.report;
  if (!take.contents.empty()) {
    return fmt::format("{}: {}: nothing to check\n",
                       Colours::of_out().paint(Paint::bold, printable(take.name)), take.contents);
  }
  std::string text = fmt::format(
      "{}: {}\n  {}, {}\n\n", Colours::of_out().paint(Paint::bold, printable(take.name)),
      summary_text(report), length_text(report.frames, report.frame_rate_hz),
      counted(report.tracks.size(), report.is_markers ? "marker" : "joint"));
  Table table({Align::left, Align::left});
  for (const Figure& entry : figures()) {
    const Value value = entry.get(report.figures);
    const bool of_markers = entry.name == "swaps", of_joints = entry.name == "flips";
    if (!value || (report.is_markers ? of_joints : of_markers)) continue;
    table.add({entry.label, with_unit(*value, unit_of(entry, report))});
  }
  for (const Diagnostic& entry : take.diagnostics.entries())
    table.add({"repaired", printable(diagnostic_text(take.source, entry))});
  text += table.text() + subjects_text(report) + findings_text(take, verbose);
  if (verbose) text += tracks_text(report);
  return text;
}

Json finding_json(const Finding& finding, std::int64_t first_frame) {
  return {{"kind", to_string(finding.kind)},
          {"severity", to_string(finding.severity)},
          {"track", finding.track.empty() ? Json() : Json(finding.track)},
          {"first_frame", frame_number(finding.first_frame, first_frame)},
          {"last_frame", frame_number(finding.last_frame, first_frame)},
          {"figure", finding.figure},
          {"unit", finding.unit},
          {"words", finding.words}};
}

Json track_json(const TrackHealth& track) {
  return {{"name", track.name},
          {"gaps", track.gaps},
          {"longest_gap", track.longest_gap},
          {"missing_frames", track.missing_frames},
          {"spikes", track.spikes},
          {"frozen", track.frozen},
          {"bridged", track.bridged},
          {"swaps", track.swaps},
          {"flips", track.flips},
          {"noise", track.noise}};
}

Json take_json(const Checked& take) {
  const CheckReport& report = take.report;
  Json json = {
      {"input", take.name},
      {"kind", report.is_markers ? "markers" : "joints"},
      {"frames", report.frames},
      {"first_frame", take.first_frame},
      {"frame_rate_hz", report.frame_rate_hz},
      {"calibration_frames", report.calibration_frames},
      {"metres_per_unit", report.metres_per_unit > 0 ? Json(report.metres_per_unit) : Json()},
      {"noise_unit", report.noise_unit},
      {"figures", Json::object()},
      {"findings", Json::array()},
      {"tracks", Json::array()},
      {"diagnostics", json_of(take.diagnostics, take.source.format)}};
  for (const Figure& entry : figures()) {
    const Value value = entry.get(report.figures);
    json["figures"][entry.name] = value ? Json(*value) : Json();
  }
  for (const Finding& finding : report.findings)
    json["findings"].push_back(finding_json(finding, take.first_frame));
  for (const TrackHealth& track : report.tracks) json["tracks"].push_back(track_json(track));
  for (const SubjectHealth& subject : report.subjects) {
    json["subjects"].push_back({{"name", subject.name},
                                {"markers", subject.markers},
                                {"slide_cm", subject.slide_cm ? Json(*subject.slide_cm) : Json()},
                                {"sink_cm", subject.sink_cm ? Json(*subject.sink_cm) : Json()}});
  }
  return json;
}

/// 1 with a line for each limit that is passed, which names the worst finding.
int check_limits(const Checked& take, const Arguments& arguments) {
  int code = 0;
  for (const Figure& entry : figures()) {
    if (!arguments.given(entry.limit)) continue;
    const double limit = arguments.number(entry.limit);
    const Value value = entry.get(take.report.figures);
    if (!value || *value <= limit) continue;
    const std::string unit = unit_of(entry, take.report);
    std::string line = fmt::format("{}: {}: {} is above the limit {}", take.name, entry.label,
                                   with_unit(*value, unit), with_unit(limit, unit));
    const auto& findings = take.report.findings;
    const auto worst = std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) {
      return std::find(entry.kinds.begin(), entry.kinds.end(), finding.kind) != entry.kinds.end();
    });
    if (worst != findings.end()) line += "; " + finding_sentence(*worst, take);
    say_error(line);
    code = 1;
  }
  return code;
}

CheckSettings check_settings(const Arguments& arguments) {
  CheckSettings settings;
  if (const std::string up = arguments.text("up"); !up.empty())
    settings.up = up == "x" ? Axis::x : up == "z" ? Axis::z : Axis::y;
  if (arguments.given("metres_per_unit"))
    settings.metres_per_unit = arguments.number("metres_per_unit");
  settings.names = names_of_map(arguments.text("map"));
  return settings;
}

Checked check_file(const std::string& input, const Arguments& arguments) {
  TakeResult read = read_take(std::filesystem::path(input), read_options(arguments));
  const CheckSettings settings = check_settings(arguments);
  CheckReport report =
      std::visit([&](const auto& take) { return check_take(take, settings); }, read.take);
  return {input_name(input),         std::move(report),         std::move(read.diagnostics),
          pointless_text(read.take), first_frame_of(read.take), source_of(read.take)};
}

int run(const Arguments& arguments) {
  const bool json = arguments.flag("json"), force = arguments.flag("force");
  const std::string gaps_out = arguments.text("gaps_out");
  check_single_use(arguments.positionals, {gaps_out}, json);
  if (!gaps_out.empty()) {
    if (arguments.positionals.size() > 1)
      throw Error(ErrorKind::usage, "--gaps-out takes the spans of one take, not of several");
    check_is_no_input("--gaps-out", gaps_out, arguments.positionals);
    check_is_no_input("--gaps-out", gaps_out, {arguments.text("map")});
    check_free(gaps_out, force);
  }
  Json takes = Json::array();
  const int code = for_each_input(arguments.positionals, takes, [&](const std::string& input) {
    const Checked take = check_file(input, arguments);
    if (!gaps_out.empty())
      write_output(gaps_out, gaps_text(take.report.stale, take.first_frame), force);
    if (json) {
      takes.push_back(take_json(take));
    } else if (gaps_out != "-") {
      write_out(take_text(take, arguments.flag("verbose")));
    }
    return check_limits(take, arguments);
  });
  if (json) write_out(json_text({{"kinemend", version()}, {"takes", std::move(takes)}}));
  return code;
}

Flag without_default(Flag flag) {
  flag.has_default = false;
  return flag;
}

std::vector<Flag> flags() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Flag gaps_out = text_flag(
      "gaps_out", "FILE", "Output", "write frozen and bridged spans as a side file of gaps",
      "kinemend fill and clean take it with --gaps, so that these spans are filled anew.");
  gaps_out.completion = Completion::file;
  Flag up = text_flag("up", "", "Checks", "vertical axis, where the body does not tell");
  up.spec.choices = {"x", "y", "z"};
  std::vector<Flag> list = {
      json_flag("print JSON instead of text"),
      switch_flag("verbose", "Output", "list every finding and every track"),
      gaps_out,
      force_flag(),
      up,
      without_default(number_flag("metres_per_unit", "m", 0, 1e-9, 1e6, "Checks",
                                  "length of a file unit, where the take does not tell")),
  };
  list.push_back(map_flag());
  append(list, reading_flags("what needs a repair becomes an error"));
  for (const Figure& entry : figures()) {
    list.push_back(without_default(
        number_flag(entry.limit, entry.unit == "noise" ? "" : entry.unit, 0, 0, infinity, "Limits",
                    fmt::format("exit code 1 where {} {} above this", entry.label,
                                entry.label.back() == 's' ? "are" : "is"))));
  }
  return list;
}

}  // namespace

Command check_command() {
  Command command;
  command.name = "check";
  command.summary = "say what is wrong with a take";
  command.description =
      "Gaps, spikes, frozen and bridged spans, noise of each joint or marker, swapped markers, "
      "lengths that change, feet that slide or sink, a rate or a unit that looks wrong, leaps of "
      "Euler angles, frames that repeat or are all zero. Findings stand worst first. Nothing is "
      "changed.\n\n"
      "Each --max option sets a limit; where a figure passes one, the exit code is 1 and the worst "
      "finding is named. A figure that a take does not have, such as the slide of feet that nobody "
      "finds or that never stand, passes none. --map names feet whose names are not known; of "
      "several people in a file of markers (Ann:LTOE, Bob:LTOE) each is judged by itself.";
  command.positionals = {{"FILE", "take to check; - is standard input", 1, 1000000, {}}};
  command.flags = flags();
  command.examples = {
      {"kinemend check walk.c3d", "what is wrong with it"},
      {"kinemend check *.bvh --max-spikes 0 --max-gap-s 0.2", "as a check in a script"},
      {"kinemend check walk.bvh --gaps-out gaps.csv", "the spans that were made up"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
