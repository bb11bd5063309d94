// Writes the result of `fill` as text.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "report/figures.hpp"
#include "report/texts.hpp"

namespace kinemend {

namespace {

double seconds_of(const TakeFacts& take, const Gap& gap) {
  return static_cast<double>(gap.length()) / take.frame_rate_hz;
}

std::string expected_text(const TakeFacts& take, const GapOutcome& gap) {
  if (!(gap.expected_error > 0)) return "";
  return measure_text(gap.expected_error, unit_of(take, gap));
}

// The number of rows in the short report. Chosen by hand.
constexpr std::size_t most_filled = 10, most_refused = 8;

std::vector<std::string> gap_cells(const TakeFacts& take, const GapOutcome& outcome) {
  const Gap& gap = outcome.gap;
  std::string name = printable_name(take.tracks[gap.track]);
  if (outcome.is_position) name += " (position)";
  return {std::move(name),
          fmt::format("{}-{}", frame_number(gap.first_frame, take.first_frame),
                      frame_number(gap.last_frame, take.first_frame)),
          grouped(gap.length()), fmt::format("{:.3f}", seconds_of(take, gap))};
}

// Lists the longest filled gaps, or all, in the order of the report.
std::string filled_table(const TakeFacts& take, const FillReport& report, bool all) {
  std::vector<const GapOutcome*> filled;
  for (const GapOutcome& outcome : report.gaps) {
    if (outcome.filled) filled.push_back(&outcome);
  }
  if (filled.empty()) return "";
  const std::size_t count = filled.size();
  if (!all && count > most_filled) {
    std::stable_sort(filled.begin(), filled.end(), [](const auto* a, const auto* b) {
      return a->gap.length() > b->gap.length();
    });
    filled.resize(most_filled);
    std::sort(filled.begin(), filled.end());
  }
  Table table({Align::left, Align::right, Align::right, Align::right, Align::left, Align::right});
  table.add({noun_of(take.kind), "frames", "length", "s", "method", "expected error"});
  for (const GapOutcome* outcome : filled) {
    std::vector<std::string> cells = gap_cells(take, *outcome);
    cells.insert(cells.end(), {outcome->method, expected_text(take, *outcome)});
    table.add(std::move(cells));
  }
  std::string text = "\n" + table.text();
  if (filled.size() < count) {
    text += fmt::format("  and {} shorter ones (--verbose lists them)\n",
                        grouped(count - filled.size()));
  }
  return text;
}

std::string refused_table(const TakeFacts& take, const FillReport& report, bool all) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::left}, 4);
  std::size_t count = 0;
  for (const GapOutcome& outcome : report.gaps) {
    if (outcome.filled || (++count > most_refused && !all)) continue;
    std::vector<std::string> cells = gap_cells(take, outcome);
    cells.push_back(printable(outcome.reason));
    table.add(std::move(cells));
  }
  if (count == 0) return "";
  std::string text = fmt::format("\n  {} refused:\n", grouped(count)) + table.text();
  if (count > most_refused && !all)
    text += fmt::format("    and {} more (--verbose lists them)\n", grouped(count - most_refused));
  return text;
}

}  // namespace

std::string methods_text(const FillReport& report) {
  std::map<std::string, std::size_t> counts;
  for (const GapOutcome& outcome : report.gaps) counts[outcome.method] += outcome.filled ? 1 : 0;
  std::vector<std::string> parts;
  for (const auto& [method, count] : counts) {
    if (count > 0) parts.push_back(fmt::format("{} by {}", grouped(count), method));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string fill_verdict(const FillOutcome& outcome) {
  const FillReport& report = outcome.report;
  if (report.gaps.empty()) {
    return report.unlabelled > 0 ? "no gaps of labelled markers" : "no gaps";
  }
  return fmt::format("{}: {} filled, {} refused", counted(report.gaps.size(), "gap"),
                     report.filled(), report.refused());
}

std::string result_text(const TakeFacts& take, const FillOutcome& outcome,
                        const TextOptions& options) {
  const FillReport& report = outcome.report;
  const std::string written =
      take.output.empty() ? "; nothing written (dry run)" : written_text(take);
  const std::string beyond = outcome.not_within_range == 0
                                 ? ""
                                 : fmt::format("; {} not within --range left alone",
                                               counted(outcome.not_within_range, "gap"));
  std::string text = painted(Paint::bold, shown_name(take), options.colours) + ": ";
  if (!take.contents.empty()) return text + take.contents + ": nothing to fill" + written + "\n";
  text += fill_verdict(outcome) + beyond + written + "\n";
  if (report.unlabelled > 0)
    text += fmt::format("  {} of unlabelled points left alone (--unlabelled fills them)\n",
                        counted(report.unlabelled, "gap"));
  if (report.gaps.empty()) return text;
  text += fmt::format("  {}", length_text(take.frames, take.frame_rate_hz));
  if (report.filled() > 0) text += "; " + methods_text(report);
  return text + "\n" + filled_table(take, report, options.all) +
         refused_table(take, report, options.all);
}

}  // namespace kinemend
