// Writes the result of `clean` as text, with its changes to the feet.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/quantiles.hpp"
#include "base/text.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "report/figures.hpp"
#include "report/texts.hpp"

namespace kinemend {

namespace {

// The longest list in the short report. Chosen by hand.
constexpr std::size_t short_list = 8;

std::string contact_text(const FeetReport& report, const FootContact& contact,
                         std::int64_t first_frame) {
  return fmt::format("{} {}, frames {} to {}", printable_name(report.sides[contact.leg]),
                     to_string(contact.part), frame_number(contact.first_frame, first_frame),
                     frame_number(contact.last_frame, first_frame));
}

// Contacts that were already still are not listed.
std::string left_alone_text(const FeetReport& report, std::int64_t first_frame, bool all_rows) {
  std::string text;
  std::size_t listed = 0;
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const bool is_news = report.held[i] == 0 && report.still[i] == 0;
    if (!is_news && !(all_rows && report.held[i] == 0)) continue;
    if (++listed > short_list && !all_rows) continue;
    text += fmt::format("    {}: {}\n", contact_text(report, report.contacts[i], first_frame),
                        report.reasons[i]);
  }
  if (listed == 0) return text;
  text = fmt::format("  {} left alone:\n", counted(listed, "contact")) + text;
  if (listed > short_list && !all_rows)
    text += fmt::format("    and {} more (--verbose lists them)\n", listed - short_list);
  return text;
}

std::string standing_text(const FeetReport& report) {
  const StandingTime& time = report.time;
  std::string text = stand_words(time);
  if (report.contacts.empty()) return text;
  text += fmt::format("; held for {:.1f} s", time.held_s);
  if (time.still_s > 0) text += fmt::format(", still for {:.1f} s", time.still_s);
  return text;
}

}  // namespace

std::string feet_text(const FeetReport& report, std::int64_t first_frame, bool all) {
  const StandingTime& time = report.time;
  std::string text = "  feet: " + standing_text(report);
  const bool in_cm = report.metres_per_unit > 0;
  const double scale = in_cm ? 100 * report.metres_per_unit : 1;
  const std::string unit = in_cm ? "cm" : "units";
  const FeetFigures &a = report.before, &b = report.after;
  // A held slide leaves rounding errors, which are shown as 0.
  const auto length = [&](double units) {
    // In the unit that is shown. Chosen by hand.
    constexpr double least = 1e-5;
    return figure(scale * units < least ? 0 : scale * units);
  };
  if (time.held_s > 0)
    text += fmt::format("; {} adjusted", counted(frames_adjusted(report), "frame"));
  if (!report.contacts.empty()) {
    text += fmt::format(
        "; slide {} to {} {}/s, {} to {} {} at most, sink {} to {} {}, knee pop {} to {} deg",
        length(report.frame_rate_hz * a.slide), length(report.frame_rate_hz * b.slide), unit,
        length(a.most_slide), length(b.most_slide), unit, length(a.sink), length(b.sink), unit,
        figure(a.knee_pop_deg), figure(b.knee_pop_deg));
  }
  return text + "\n" + left_alone_text(report, first_frame, all);
}

namespace {

// A take with less jitter is not called noisy.
double noticeable_noise(const CleanReport& report) {
  // Chosen by hand, not swept.
  constexpr double noticeable_deg = 0.1;
  constexpr double noticeable_heights = 0.5 / 1750;  // half a millimetre of a person
  return report.kind == TakeKind::markers ? noticeable_heights * report.body_height
                                          : noticeable_deg;
}

struct TypicalNoise {
  double size = 0;
  std::size_t tracks = 0;
};

// Returns the median noise of the smoothed tracks that have noise; 0 without any.
TypicalNoise typical_noise(const CleanReport& report, double TrackSummary::*noise) {
  std::vector<double> noises;
  for (const TrackSummary& row : report.tracks) {
    if (row.frames_changed > row.frames_repaired && row.*noise > 0) noises.push_back(row.*noise);
  }
  if (noises.empty()) return {};
  const auto middle = noises.begin() + static_cast<std::ptrdiff_t>(noises.size() / 2);
  std::nth_element(noises.begin(), middle, noises.end());
  return {*middle, noises.size()};
}

// Returns the changed tracks, the most changed first.
std::vector<const TrackSummary*> changed_rows(const CleanReport& report) {
  std::vector<const TrackSummary*> rows;
  for (const TrackSummary& row : report.tracks) {
    if (row.frames_changed > 0) rows.push_back(&row);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto* a, const auto* b) { return a->rms_change > b->rms_change; });
  return rows;
}

std::string change_table(const CleanReport& report, bool all_rows) {
  const std::vector<const TrackSummary*> rows = changed_rows(report);
  if (rows.empty()) return "";
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right,
               Align::right});
  const ShownUnit shown_in = shown_unit(report.unit);
  const std::string unit = shown_in.name;
  const std::string speed_unit = report.unit.empty() ? unit : report.unit;
  const auto length = [&](double value) { return figure(shown_in.factor * value); };
  table.add({noun_of(report.kind), "noise " + unit, "change rms " + unit, "max " + unit,
             "frames repaired", "peak " + speed_unit + "/s before", "after"});
  const std::size_t shown = all_rows ? rows.size() : std::min(rows.size(), short_list);
  for (std::size_t i = 0; i < shown; ++i) {
    const TrackSummary& row = *rows[i];
    table.add({printable_name(row.name), row.noise > 0 ? length(row.noise) : "-",
               length(row.rms_change), length(row.max_change),
               row.frames_repaired > 0 ? grouped(row.frames_repaired) : "-",
               figure(row.peak_speed_before), figure(row.peak_speed_after)});
  }
  std::string text = table.text();
  if (shown < rows.size())
    text += fmt::format("  and {} that changed less (--verbose lists them)\n",
                        counted(rows.size() - shown, noun_of(report.kind)));
  return text;
}

// Lists filled gaps by method, and refused gaps on one line each.
std::string gaps_text(const CleanReport& report, std::int64_t first_frame, bool all_rows) {
  std::string unlabelled =
      report.fill.unlabelled == 0
          ? ""
          : fmt::format("  {} of unlabelled points left alone (--unlabelled fills them)\n",
                        counted(report.fill.unlabelled, "gap"));
  if (report.fill.gaps.empty()) return unlabelled;
  std::string refused;
  std::size_t listed = 0;
  for (const GapOutcome& outcome : report.fill.gaps) {
    if (outcome.filled) continue;
    if (++listed > short_list && !all_rows) continue;
    refused += fmt::format("    {}, frames {} to {}: {}\n",
                           printable_name(report.tracks[outcome.gap.track].name),
                           frame_number(outcome.gap.first_frame, first_frame),
                           frame_number(outcome.gap.last_frame, first_frame), outcome.reason);
  }
  std::string text = fmt::format("  {} of {} filled", report.fill.filled(),
                                 counted(report.fill.gaps.size(), "gap"));
  if (report.fill.filled() > 0) text += ": " + methods_text(report.fill);
  text += "\n";
  if (listed > 0) text += fmt::format("  {} refused:\n{}", listed, refused);
  if (listed > short_list && !all_rows)
    text += fmt::format("    and {} more (--verbose lists them)\n", listed - short_list);
  return text + unlabelled;
}

std::string swap_text(const CleanReport& report, std::int64_t first_frame) {
  std::string text;
  for (const MarkerSwap& swap : report.swaps) {
    text += fmt::format("  {} and {} were swapped in frames {} to {}\n",
                        printable_name(report.tracks[swap.first_marker].name),
                        printable_name(report.tracks[swap.second_marker].name),
                        frame_number(swap.first_frame, first_frame),
                        frame_number(swap.last_frame, first_frame));
  }
  return text;
}

std::string leftovers_text(const TakeFacts& take, const CleanReport& report) {
  std::string text;
  for (const Leftover& leftover : report.leftovers)
    text += fmt::format("  {} ({})\n", leftover.what, advice_of(leftover, take));
  return text;
}

// Only tracks that changed are listed; an untouched track has no fall-back.
std::string fall_backs_text(const CleanReport& report, bool all_rows) {
  // The number of rows in the short report. Chosen by hand.
  constexpr std::size_t few = 4;
  std::string text;
  for (const FallBack& fall_back : report.fall_backs) {
    std::vector<std::string> names;
    double sum = 0;
    for (std::size_t i = 0; i < fall_back.tracks.size(); ++i) {
      if (!is_changed(report, fall_back.tracks[i])) continue;
      names.push_back(printable_name(track_name(report, fall_back.tracks[i])));
      sum += fall_back.shares[i];
    }
    if (names.empty()) continue;
    const double share = sum / static_cast<double>(names.size());
    text +=
        fmt::format("  {} in place of {} for {}{}: {}", fall_back.method, report.method,
                    counted(names.size(), noun_of(report.kind)),
                    share < 0.995 ? fmt::format(" ({:.0f} %)", 100 * share) : "", fall_back.reason);
    if (all_rows || names.size() <= few) text += fmt::format(" ({})", fmt::join(names, ", "));
    text += "\n";
  }
  return text;
}

// Counts the changed joints or markers that other methods cleaned more than the requested one.
std::size_t count_fallen_back(const CleanReport& report) {
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

}  // namespace

std::string clean_verdict(const TakeFacts& take, const CleanReport& report) {
  if (!take.contents.empty()) return take.contents + ": nothing to clean";
  const std::size_t changed = tracks_changed(report);
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
    if (left_over.empty() && report.warnings.empty()) return "clean: nothing changed";
    if (left_over.empty()) left_over.push_back(counted(report.warnings.size(), "warning"));
    const char* result = swaps.empty() ? "nothing changed" : "mended";
    return fmt::format("{}: {}", result, fmt::join(left_over, ", "));
  }
  const TypicalNoise jitter = typical_noise(report, &TrackSummary::noise);
  const TypicalNoise expected = typical_noise(report, &TrackSummary::expected_noise);
  // Noise that does not show from frame to frame is known only from the model.
  const bool is_expected = jitter.size < noticeable_noise(report) && expected.size > jitter.size;
  const TypicalNoise noise = is_expected ? expected : jitter;
  std::vector<std::string> findings;
  if (noise.size > 0) {
    findings.push_back(fmt::format("{} {} on {}", measure_text(noise.size, report.unit),
                                   is_expected ? "noise expected" : "jitter",
                                   counted(noise.tracks, noun_of(report.kind))));
  } else if (changed > 0) {
    findings.push_back(counted(changed, noun_of(report.kind)) + " changed");
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
                       report.method, counted(count, noun_of(report.kind)));
  if (noise.size >= noticeable_noise(report)) return "noisy: " + all;
  if (spikes + gaps + report.swaps.size() > 0) return "damaged: " + all;
  return noise.size > 0 ? "nearly clean: " + all : "smoothed: " + all;
}

namespace {

// Returns the take's name, the verdict and the output path on one line.
std::string headline(const TakeFacts& take, const CleanReport& report, bool colours) {
  const std::string result = clean_verdict(take, report);
  const bool is_good = result.compare(0, 5, "noisy") != 0 && result.compare(0, 7, "damaged") != 0;
  const std::string line = fmt::format(
      "{}: {}", shown_name(take), painted(is_good ? Paint::green : Paint::yellow, result, colours));
  return line + (take.output.empty() ? "; nothing written (--dry-run)" : written_text(take)) + "\n";
}

// Returns the expected error of the result, if the method states it.
std::string left_text(const CleanReport& report) {
  std::vector<double> all;
  const TrackSummary* worst = nullptr;
  for (const TrackSummary& track : report.tracks) {
    if (track.left <= 0) continue;
    all.push_back(track.left);
    if (worst == nullptr || track.left > worst->left) worst = &track;
  }
  if (worst == nullptr) return "";
  return fmt::format("  expected to be left: {} per axis, most {} ({})\n",
                     measure_text(median_of(all), report.unit), printable_name(worst->name),
                     measure_text(worst->left, report.unit));
}

// Returns a table of the changes, the gaps, and the totals.
std::string details(const TakeFacts& take, const CleanReport& report, bool all_rows) {
  if (!take.contents.empty()) return "";
  std::string text = fmt::format("  {}, method {}",
                                 length_text(report.frames, report.frame_rate_hz), report.method);
  if (report.calibration_frames > 0) {
    text += fmt::format(
        "; the first {} a calibration pose and left alone",
        report.calibration_frames == 1 ? "is" : fmt::format("{} are", report.calibration_frames));
  }
  text += "\n";
  text += fmt::format("  source: {}\n", source_words(report.source));
  if (const std::string table = change_table(report, all_rows); !table.empty())
    text += "\n" + table + "\n";
  if (report.root_max_change > 0) {
    text += fmt::format("  root position: change rms {}, max {} (file units)\n",
                        figure(report.root_rms_change), figure(report.root_max_change));
  }
  for (const NoiseCharacter& noise : report.noise)
    text += fmt::format("  noise: {}\n",
                        noise_words(noise, report.kind, report.unit, report.frame_rate_hz));
  text += left_text(report);
  for (const std::string& note : report.notes) text += fmt::format("  {}\n", note);
  text += fall_backs_text(report, all_rows) + swap_text(report, take.first_frame) +
          gaps_text(report, take.first_frame, all_rows) + leftovers_text(take, report);
  if (report.feet) text += feet_text(*report.feet, take.first_frame, all_rows);
  text += fmt::format("  {} of {} changed, {} repaired", tracks_changed(report),
                      counted(tracks_counted(report), noun_of(report.kind)),
                      counted(frames_repaired(report), "frame"));
  if (report.seconds > 0)
    text +=
        fmt::format("; {} frames/s", grouped(static_cast<std::size_t>(frames_per_second(report))));
  return text + "\n";
}

}  // namespace

std::string result_text(const TakeFacts& take, const CleanReport& report,
                        const TextOptions& options) {
  std::string text = headline(take, report, options.colours);
  if (options.details) text += details(take, report, options.all);
  return text;
}

}  // namespace kinemend
