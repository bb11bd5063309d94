// Figures, findings and rules of results, for the text, the limits and the JSON.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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

}  // namespace kinemend
