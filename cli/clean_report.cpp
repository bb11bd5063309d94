#include "clean_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "feet_report.hpp"
#include "json.hpp"
#include "table.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

constexpr std::size_t short_list = 8;

bool is_repair(Action action) { return action == Action::despiked || action == Action::filled; }

std::size_t count_spans(const ReportView& report, Action action) {
  return static_cast<std::size_t>(
      std::count_if(report.spans.begin(), report.spans.end(),
                    [&](const ReportSpan& span) { return span.action == action; }));
}

std::size_t count_changed(const ReportView& report) {
  return static_cast<std::size_t>(
      std::count_if(report.rows.begin(), report.rows.end(),
                    [](const ReportView::Row& row) { return row.frames_changed > 0; }));
}

/// Frames in which at least one joint or marker was repaired.
std::size_t frames_repaired(const ReportView& report) {
  std::vector<bool> repaired(report.frames, false);
  for (const ReportSpan& span : report.spans) {
    if (!is_repair(span.action)) continue;
    for (std::size_t f = span.first_frame; f <= span.last_frame && f < repaired.size(); ++f)
      repaired[f] = true;
  }
  return static_cast<std::size_t>(std::count(repaired.begin(), repaired.end(), true));
}

std::size_t gaps_left(const ReportView& report) {
  std::size_t gaps = 0;
  for (const ReportView::Row& row : report.rows) gaps += row.gaps_left;
  return gaps;
}

/// What changed, most first.
std::vector<const ReportView::Row*> changed_rows(const ReportView& report) {
  std::vector<const ReportView::Row*> rows;
  for (const ReportView::Row& row : report.rows) {
    if (row.frames_changed > 0) rows.push_back(&row);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto* a, const auto* b) { return a->rms_change > b->rms_change; });
  return rows;
}

/// The middle one of the noises of what was smoothed and has one; 0 without any.
double typical_noise(const ReportView& report, std::size_t& count) {
  std::vector<double> noises;
  for (const ReportView::Row& row : report.rows) {
    if (row.frames_changed > row.frames_repaired && row.noise > 0) noises.push_back(row.noise);
  }
  count = noises.size();
  if (noises.empty()) return 0;
  const auto middle = noises.begin() + static_cast<std::ptrdiff_t>(noises.size() / 2);
  std::nth_element(noises.begin(), middle, noises.end());
  return *middle;
}

double frames_per_second(const ReportView& report) {
  return report.seconds > 0 ? static_cast<double>(report.frames) / report.seconds : 0;
}

std::string change_table(const ReportView& report, bool all_rows) {
  const std::vector<const ReportView::Row*> rows = changed_rows(report);
  if (rows.empty()) return "";
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right,
               Align::right});
  const std::string& unit = report.unit;
  table.add({report.noun(), "noise " + unit, "change rms " + unit, "max " + unit, "frames repaired",
             "peak " + unit + "/s before", "after"});
  const std::size_t shown = all_rows ? rows.size() : std::min(rows.size(), short_list);
  for (std::size_t i = 0; i < shown; ++i) {
    const ReportView::Row& row = *rows[i];
    table.add({printable(row.name), row.noise > 0 ? figure(row.noise) : "-", figure(row.rms_change),
               figure(row.max_change), row.frames_repaired > 0 ? grouped(row.frames_repaired) : "-",
               figure(row.peak_speed_before), figure(row.peak_speed_after)});
  }
  std::string text = table.text();
  if (shown < rows.size())
    text += fmt::format("  and {} that changed less (--verbose lists them)\n",
                        counted(rows.size() - shown, report.noun()));
  return text;
}

/// Gaps that were filled, by method, and those that were refused, one a line.
std::string fill_text(const ReportView& report, bool all_rows) {
  if (report.fill.gaps.empty()) return "";
  std::map<std::string, std::size_t> filled;
  std::string refused;
  std::size_t listed = 0;
  for (const GapOutcome& outcome : report.fill.gaps) {
    if (outcome.filled) {
      ++filled[outcome.method];
      continue;
    }
    if (++listed > short_list && !all_rows) continue;
    refused +=
        fmt::format("    {}, frames {} to {}: {}\n", printable(report.rows[outcome.gap.track].name),
                    frame_number(outcome.gap.first_frame, report.first_frame),
                    frame_number(outcome.gap.last_frame, report.first_frame), outcome.reason);
  }
  std::vector<std::string> methods;
  methods.reserve(filled.size());
  for (const auto& [method, count] : filled)
    methods.push_back(fmt::format("{} by {}", grouped(count), method));
  std::string text = fmt::format("  {} of {} filled", report.fill.filled(),
                                 counted(report.fill.gaps.size(), "gap"));
  if (!methods.empty()) text += fmt::format(": {}", fmt::join(methods, ", "));
  text += "\n";
  if (listed > 0) text += fmt::format("  {} refused:\n{}", listed, refused);
  if (listed > short_list && !all_rows)
    text += fmt::format("    and {} more (--verbose lists them)\n", listed - short_list);
  return text;
}

std::string swap_text(const ReportView& report) {
  std::string text;
  for (const MarkerSwap& swap : report.swaps) {
    text += fmt::format("  {} and {} were swapped in frames {} to {}\n",
                        printable(report.rows[swap.first_marker].name),
                        printable(report.rows[swap.second_marker].name),
                        frame_number(swap.first_frame, report.first_frame),
                        frame_number(swap.last_frame, report.first_frame));
  }
  return text;
}

std::string leftovers_text(const ReportView& report) {
  std::string text;
  for (const Leftover& leftover : report.leftovers)
    text += fmt::format("  {} ({})\n", leftover.what, leftover.mend);
  return text;
}

std::string name_of(const ReportView& report, std::int32_t track) {
  return track < 0 ? "root position" : report.rows[track].name;
}

bool is_changed(const ReportView& report, std::int32_t track) {
  return track < 0 ? report.root_max_change > 0 : report.rows[track].frames_changed > 0;
}

/// Of tracks that changed at all: what nobody touched fell back to nothing.
std::string fall_backs_text(const ReportView& report, bool all_rows) {
  constexpr std::size_t few = 4;
  std::string text;
  for (const FallBack& fall_back : report.fall_backs) {
    std::vector<std::string> names;
    double sum = 0;
    for (std::size_t i = 0; i < fall_back.tracks.size(); ++i) {
      if (!is_changed(report, fall_back.tracks[i])) continue;
      names.push_back(printable(name_of(report, fall_back.tracks[i])));
      sum += fall_back.shares[i];
    }
    if (names.empty()) continue;
    const double share = sum / static_cast<double>(names.size());
    text +=
        fmt::format("  {} in place of {} for {}{}: {}", fall_back.method, report.method,
                    counted(names.size(), report.noun()),
                    share < 0.995 ? fmt::format(" ({:.0f} %)", 100 * share) : "", fall_back.reason);
    if (all_rows || names.size() <= few) text += fmt::format(" ({})", fmt::join(names, ", "));
    text += "\n";
  }
  return text;
}

/// Changed joints or markers that are more another method's than the one's that was asked for.
std::size_t count_fallen_back(const ReportView& report) {
  std::map<std::int32_t, double> shares;
  for (const FallBack& fall_back : report.fall_backs) {
    for (std::size_t i = 0; i < fall_back.tracks.size(); ++i) {
      const std::int32_t track = fall_back.tracks[i];
      if (track >= 0 && is_changed(report, track)) shares[track] += fall_back.shares[i];
    }
  }
  return static_cast<std::size_t>(std::count_if(
      shares.begin(), shares.end(), [](const auto& entry) { return entry.second > 0.5; }));
}

Json fall_backs_json(const ReportView& report) {
  Json list = Json::array();
  for (const FallBack& fall_back : report.fall_backs) {
    Json tracks = Json::array();
    for (std::size_t i = 0; i < fall_back.tracks.size(); ++i) {
      tracks.push_back(
          {{"name", name_of(report, fall_back.tracks[i])}, {"share", fall_back.shares[i]}});
    }
    list.push_back({{"method", fall_back.method},
                    {"reason", fall_back.reason},
                    {std::string(report.noun()) + "s", tracks}});
  }
  return list;
}

Json leftovers_json(const ReportView& report) {
  Json list = Json::array();
  for (const Leftover& leftover : report.leftovers)
    list.push_back({{"what", leftover.what}, {"mend", leftover.mend}});
  return list;
}

/// The keys of joints end in their unit; markers are in the file's, which `unit` names.
Json row_json(const ReportView::Row& row, const ReportView& report) {
  const std::string unit = report.is_markers ? "" : "_deg";
  const std::string speed_unit = report.is_markers ? "" : "_deg_s";
  Json json = {{"name", row.name},
               {"noise" + unit, row.noise},
               {"rms_change" + unit, row.rms_change},
               {"max_change" + unit, row.max_change},
               {"frames_changed", row.frames_changed},
               {"frames_repaired", row.frames_repaired},
               {"peak_speed_before" + speed_unit, row.peak_speed_before},
               {"peak_speed_after" + speed_unit, row.peak_speed_after},
               {"peak_frames", row.peak_frames}};
  if (report.is_markers) {
    json["gaps_left"] = row.gaps_left;
    json["frames_missing"] = row.frames_missing;
  }
  return json;
}

/// The root position's changes are in file units, and its span says so by its keys.
Json span_json(const ReportSpan& span, const ReportView& report) {
  const bool is_root = span.joint < 0;
  const std::string unit = is_root || report.is_markers ? "" : "_deg";
  return {{report.noun(), is_root ? Json() : Json(report.rows[span.joint].name)},
          {"index", span.joint},
          {"first_frame", frame_number(span.first_frame, report.first_frame)},
          {"last_frame", frame_number(span.last_frame, report.first_frame)},
          {"action", to_string(span.action)},
          {"max_change" + unit, span.max_change},
          {"rms_change" + unit, span.rms_change}};
}

Json fill_json(const ReportView& report) {
  Json gaps = Json::array();
  for (const GapOutcome& outcome : report.fill.gaps) {
    Json gap = {{report.noun(), report.rows[outcome.gap.track].name},
                {"first_frame", frame_number(outcome.gap.first_frame, report.first_frame)},
                {"last_frame", frame_number(outcome.gap.last_frame, report.first_frame)},
                {"filled", outcome.filled},
                {"method", outcome.method}};
    if (!outcome.filled) gap["reason"] = outcome.reason;
    gaps.push_back(std::move(gap));
  }
  return {{"filled", report.fill.filled()}, {"refused", report.fill.refused()}, {"gaps", gaps}};
}

Json swaps_json(const ReportView& report) {
  Json swaps = Json::array();
  for (const MarkerSwap& swap : report.swaps) {
    swaps.push_back(
        {{"markers", {report.rows[swap.first_marker].name, report.rows[swap.second_marker].name}},
         {"first_frame", frame_number(swap.first_frame, report.first_frame)},
         {"last_frame", frame_number(swap.last_frame, report.first_frame)}});
  }
  return swaps;
}

}  // namespace

std::string verdict(const ReportView& report) {
  if (!report.contents.empty()) return report.contents + ": nothing to clean";
  const std::size_t changed = count_changed(report);
  const std::size_t spikes = count_spans(report, Action::despiked);
  const std::size_t gaps = count_spans(report, Action::filled);
  const std::size_t left = gaps_left(report);
  std::vector<std::string> left_over;
  if (left > 0) left_over.push_back(counted(left, "gap") + " left");
  for (const Leftover& leftover : report.leftovers) left_over.push_back(leftover.what);
  const std::string swaps =
      report.swaps.empty() ? "" : counted(report.swaps.size(), "swap") + " of markers undone";
  if (changed == 0 && report.root_max_change == 0) {
    if (!swaps.empty()) left_over.insert(left_over.begin(), swaps);
    if (left_over.empty()) return "clean: nothing changed";
    const char* result = swaps.empty() ? "nothing changed" : "mended";
    return fmt::format("{}: {}", result, fmt::join(left_over, ", "));
  }
  std::size_t noisy = 0;
  const double noise = typical_noise(report, noisy);
  std::vector<std::string> findings;
  if (noise > 0) {
    findings.push_back(fmt::format("{} {} jitter on {}", figure(noise), report.unit,
                                   counted(noisy, report.noun())));
  } else if (changed > 0) {
    findings.push_back(counted(changed, report.noun()) + " changed");
  } else {
    findings.push_back("the root position changed");
  }
  if (spikes > 0) findings.push_back(counted(spikes, "spike"));
  if (gaps > 0) findings.push_back(counted(gaps, "gap"));
  if (!swaps.empty()) findings.push_back(swaps);
  findings.insert(findings.end(), left_over.begin(), left_over.end());
  std::string all = fmt::format("{}", fmt::join(findings, ", "));
  if (const std::size_t count = count_fallen_back(report); count > 0)
    all += fmt::format("; {} in place of {} for {}", report.fall_backs.front().method,
                       report.method, counted(count, report.noun()));
  if (noise >= report.noticeable_noise) return "noisy: " + all;
  if (spikes + gaps + report.swaps.size() > 0) return "damaged: " + all;
  return noise > 0 ? "nearly clean: " + all : "smoothed: " + all;
}

std::string headline(const CleanJob& job, const ReportView& report, const CleanPlan& plan,
                     const Colours& colours) {
  const std::string result = verdict(report);
  const bool is_good = result.compare(0, 5, "noisy") != 0 && result.compare(0, 7, "damaged") != 0;
  std::string line = fmt::format("{}: {}", printable(input_name(job.input)),
                                 colours.paint(is_good ? Paint::green : Paint::yellow, result));
  if (plan.dry_run) return line + "; nothing written (--dry-run)\n";
  if (job.output != "-") line += "; written to " + printable(job.output);
  return line + "\n";
}

std::string report_text(const ReportView& report, bool all_rows) {
  if (!report.contents.empty()) return "";
  std::string text = fmt::format("  {}, method {}",
                                 length_text(report.frames, report.frame_rate_hz), report.method);
  if (report.calibration_frames > 0) {
    text += fmt::format(
        "; the first {} a calibration pose and left alone",
        report.calibration_frames == 1 ? "is" : fmt::format("{} are", report.calibration_frames));
  }
  text += "\n";
  if (const std::string table = change_table(report, all_rows); !table.empty())
    text += "\n" + table + "\n";
  if (report.root_max_change > 0) {
    text += fmt::format("  root position: change rms {}, max {} (file units)\n",
                        figure(report.root_rms_change), figure(report.root_max_change));
  }
  text += fall_backs_text(report, all_rows) + swap_text(report) + fill_text(report, all_rows) +
          leftovers_text(report);
  if (report.feet) text += feet_text(*report.feet, report.first_frame, all_rows);
  text += fmt::format("  {} of {} changed, {} repaired", count_changed(report),
                      counted(report.rows.size(), report.noun()),
                      counted(frames_repaired(report), "frame"));
  if (report.seconds > 0)
    text +=
        fmt::format("; {} frames/s", grouped(static_cast<std::size_t>(frames_per_second(report))));
  return text + "\n";
}

Json report_json(const CleanJob& job, const ReportView& report, const Diagnostics& diagnostics,
                 const CleanPlan& plan, bool with_spans) {
  Json json = {{"input", job.input},
               {"output", plan.dry_run ? Json() : Json(job.output)},
               {"verdict", verdict(report)},
               {"method", report.method},
               {"options", json_of(plan.options)},
               {"frames", report.frames},
               {"frame_rate_hz", report.frame_rate_hz},
               {"calibration_frames", report.calibration_frames},
               {std::string(report.noun()) + "s_changed", count_changed(report)},
               {"frames_repaired", frames_repaired(report)},
               {"spikes", count_spans(report, Action::despiked)},
               {"gaps", count_spans(report, Action::filled)}};
  if (report.is_markers) {
    json["unit"] = report.unit;
    json["gaps_left"] = gaps_left(report);
  } else {
    json["root_rms_change"] = report.root_rms_change;
    json["root_max_change"] = report.root_max_change;
  }
  if (!report.fill.gaps.empty()) json["fill"] = fill_json(report);
  if (report.feet) json["feet"] = feet_json(*report.feet, report.first_frame);
  if (plan.fix_swaps && report.is_markers) json["swaps_undone"] = swaps_json(report);
  json["seconds"] = report.seconds;
  json["frames_per_second"] = frames_per_second(report);
  json["fall_backs"] = fall_backs_json(report);
  json["leftovers"] = leftovers_json(report);
  json["warnings"] = report.warnings;
  json["diagnostics"] = json_of(diagnostics, report.format);
  Json& rows = json[std::string(report.noun()) + "s"] = Json::array();
  for (const ReportView::Row& row : report.rows) rows.push_back(row_json(row, report));
  if (with_spans) {
    json["spans"] = Json::array();
    for (const ReportSpan& span : report.spans) json["spans"].push_back(span_json(span, report));
  }
  return json;
}

}  // namespace kinemend::cli
