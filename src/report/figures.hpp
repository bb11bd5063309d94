#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "kinemend/report.hpp"

// The figures of `check` and `compare`, each defined once for text, JSON and limits.
namespace kinemend {

struct CheckFigure {
  FigureRule rule;
  std::array<FindingKind, 2> kinds;  ///< findings that the figure sums up; one may stand twice
  std::optional<double> (*get)(const CheckFigures& figures);
};
std::span<const CheckFigure> check_figure_table();
/// Of a figure whose rule names no unit and that is no count, that of the tracks.
std::string unit_of(const CheckFigure& figure, const CheckReport& report);

struct ComparisonFigure {
  FigureRule rule;
  std::optional<double> (*get)(const Comparison& comparison);
};
std::span<const ComparisonFigure> comparison_figure_table();

}  // namespace kinemend
