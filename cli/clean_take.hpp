// Cleans one take of a plan and returns only text, so that a batch does not grow in memory.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clean_plan.hpp"
#include "kinemend/experimental/batch_rows.hpp"

namespace kinemend::cli {

/// What is left of a take when it is done: text, not motion, so that any number of takes fits.
struct Outcome {
  int code = 0;
  std::string text;
  std::vector<std::string> warnings;
  std::string error;
  std::string json;             ///< entry of --json; empty when not asked for
  std::string report;           ///< entry of a --report that is JSON
  std::string page;             ///< of `CleanPlan::page`
  std::string picture;          ///< SVG of a few poses, for the index of a batch with pages
  std::optional<BatchRow> row;  ///< of `CleanPlan::row_name`
};

/// Told what is being done with a take and how far it is (0..1).
using TakeProgress = std::function<void(std::string_view stage, double done)>;

/// Reads, cleans and writes one take as the plan says. What goes wrong with it is in the outcome.
Outcome try_take(const CleanJob& job, const CleanPlan& plan, const TakeProgress& progress = {});

}  // namespace kinemend::cli
