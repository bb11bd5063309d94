// The rows of the table of regret: kinds of noise and sources, with the takes that stand for each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment.hpp"

namespace kinemend::papers {

/// A take and its measured figures.
struct RegretCase {
  Take take;
  /// Returns one figure for each of `RegretRow::figures`.
  std::function<std::vector<double>(const Take& cleaned)> errors{};
};

struct RegretRow {
  std::string name;
  std::string unit;  ///< unit of the errors; empty: they have several units
  /// The measured figures: one named "", or several, each of which is a row of the table.
  std::vector<std::string> figures{""};
  std::size_t cut_by = 0;            ///< the figure by which the best cut is chosen
  std::vector<double> cutoffs_hz{};  ///< cutoffs tried for the best cut
  bool is_clean = false;             ///< errors are changes of takes that need none
  bool has_gaps = false;             ///< gaps are filled after cleaning
  bool has_slow = true;              ///< slow methods are tried on the first take
  /// Each function makes its take when called, so that only one is in memory at a time.
  std::vector<std::function<RegretCase()>> cases{};
};

/// Joints, markers, pairs of systems, and clean takes, in this order.
std::vector<RegretRow> regret_rows(const Arguments& arguments);

}  // namespace kinemend::papers
