// Figures, findings and rules of results, for the text, the limits and the JSON.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "kinemend/report.hpp"

namespace kinemend {

/// "rotation" or "position".
std::string_view quantity_of(const TakeFacts& take, const GapOutcome& gap);
/// Of the expected error; empty where it is not known.
std::string unit_of(const TakeFacts& take, const GapOutcome& gap);

struct CheckFigure {
  FigureRule rule;
  std::array<FindingKind, 2> kinds;  ///< findings that the figure sums up; one may stand twice
  std::optional<double> (*get)(const CheckFigures& figures);
};
std::span<const CheckFigure> check_figure_table();
/// Of a figure whose rule names no unit and that is no count, that of the tracks.
std::string unit_of(const CheckFigure& figure, const CheckReport& report);

template <class Figures>
struct FigureOf {
  FigureRule rule;
  std::optional<double> (*get)(const Figures& figures);
};
using ComparisonFigure = FigureOf<Comparison>;
std::span<const ComparisonFigure> comparison_figure_table();

/// Of a rule that names no unit, that of the markers; "/s" is that unit a second.
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
