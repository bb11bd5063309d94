// Gives the figures and the counts of results, and their rules, for the text, the limits and the
// JSON.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "kinemend/clean.hpp"
#include "kinemend/report.hpp"

namespace kinemend {

/// Returns "rotation" or "position".
std::string_view quantity_of(const TakeFacts& take, const GapOutcome& gap);
/// Returns the unit of the expected error; empty if the error is unknown.
std::string unit_of(const TakeFacts& take, const GapOutcome& gap);

struct CheckFigure {
  FigureRule rule;
  std::array<FindingKind, 2> kinds;  ///< findings that the figure sums up; one may appear twice
  std::optional<double> (*get)(const CheckFigures& figures);
};
std::span<const CheckFigure> check_figure_table();
/// Returns the rule's unit, or that of the tracks if the rule names none and the figure is not a
/// count.
std::string unit_of(const CheckFigure& figure, const CheckReport& report);

template <class Figures>
struct FigureOf {
  FigureRule rule;
  std::optional<double> (*get)(const Figures& figures);
};
using ComparisonFigure = FigureOf<Comparison>;
std::span<const ComparisonFigure> comparison_figure_table();

/// If the rule names no unit, the unit is that of the markers; "/s" is that unit per second.
using MarkerComparisonFigure = FigureOf<MarkerComparison>;
std::span<const MarkerComparisonFigure> marker_comparison_figure_table();
std::string unit_of(const FigureRule& rule, const TakeFacts& take);

/// Calls `work(rule, value)` for each figure of a comparison.
template <class Work>
void for_each_figure(const CompareOutcome& outcome, const Work& work) {
  if (outcome.markers) {
    for (const MarkerComparisonFigure& figure : marker_comparison_figure_table())
      work(figure.rule, figure.get(*outcome.markers));
    return;
  }
  for (const ComparisonFigure& figure : comparison_figure_table())
    work(figure.rule, figure.get(outcome.comparison));
}

std::size_t count_spans(const CleanReport& report, Action action);
/// Counts spikes of three frames or more.
std::size_t count_bursts(const CleanReport& report);
/// Counts joints, or markers without points that are angles or forces.
std::size_t tracks_counted(const CleanReport& report);
std::size_t tracks_changed(const CleanReport& report);
/// Counts the frames in which at least one joint or marker was repaired.
std::size_t frames_repaired(const CleanReport& report);
std::size_t gaps_left(const CleanReport& report);
/// Returns the number of frames cleaned a second.
double frames_per_second(const CleanReport& report);
/// `track`: -1 for the root position.
bool is_changed(const CleanReport& report, std::int32_t track);
std::string track_name(const CleanReport& report, std::int32_t track);
/// Counts the frames in which a leg turned or the body was lowered.
std::size_t frames_adjusted(const FeetReport& report);
std::size_t contacts_held(const FeetReport& report);

}  // namespace kinemend
