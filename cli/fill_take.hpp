// Fills the gaps of one take as the command line asks, for `fill` and for `view`.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "frame_range.hpp"
#include "kinemend/experimental/gap_plan.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "page_report.hpp"
#include "take_jobs.hpp"

namespace kinemend::cli {

/// All that `fill` was asked for, checked.
struct FillRun {
  TakeJobs takes;
  std::string plan_out_path;
  ReportFiles reports;
  /// Of --gaps and --plan: bytes and name. Names and frames are those of a take.
  std::optional<std::pair<std::string, std::string>> gaps, plan;
  FillSettings settings;
  std::optional<double> max_error_mm;
  std::optional<FrameRange> range;
  ReadOptions reading;
  bool preview = false;
  int threads = 0;  ///< 0: as many as there are cores
  bool json = false, force = false, dry_run = false, strict = false, quiet = false, verbose = false;
};

/// Errors: `ErrorKind::usage`; of files that cannot be read or written, theirs.
FillRun fill_run_of(const Arguments& arguments);

/// A take with its gaps filled.
struct FilledTake {
  Take before, after;
  Report report;          ///< without the output
  std::string plan_text;  ///< as --plan-out asks for it; empty where it does not
  std::vector<std::string> warnings;

  std::size_t refused() const { return std::get<FillOutcome>(report.result).report.refused(); }
};

/// Reads the take of a job and fills its gaps; writes nothing. `before` is kept where `with_before`
/// is set. What `check` throws ends it.
FilledTake fill_take(const FillRun& run, const TakeJob& job, bool with_before,
                     const FillCheck& check = {});
/// The curves by which every method would fill one gap of the first take: that of a row of the
/// plan. Errors: as of `fill_take`; `ErrorKind::usage` for a run without a plan.
GapCurves gap_curves(const FillRun& run, std::size_t row, const FillCheck& check);

}  // namespace kinemend::cli
