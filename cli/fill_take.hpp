// Fills the gaps of one take by the command line, for `fill` and for `view`.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "frame_range.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "page_report.hpp"
#include "take_jobs.hpp"

namespace kinemend::cli {

/// The checked request of a `fill` run.
struct FillRun {
  TakeJobs takes;
  std::string plan_out_path;
  ReportFiles reports;
  /// Bytes and name of the files of --gaps and --plan; names and frames are checked per take.
  std::optional<std::pair<std::string, std::string>> gaps, plan;
  FillSettings settings;
  std::optional<double> max_error_mm;
  std::optional<FrameRange> range;
  ReadOptions reading;
  bool preview = false;
  int threads = 0;  ///< 0: one per core
  bool json = false, force = false, dry_run = false, strict = false, quiet = false, verbose = false;
};

/// Errors: `ErrorKind::usage`; those of reading and writing files.
FillRun fill_run_of(const Arguments& arguments);

/// A take with its gaps filled.
struct FilledTake {
  Take before, after;
  Report report;          ///< without the output
  std::string plan_text;  ///< the plan for --plan-out; empty if none is asked for
  std::vector<std::string> warnings;

  std::size_t refused() const { return std::get<FillOutcome>(report.result).report.refused(); }
};

/// Reads the take of a job and fills its gaps; writes no file. Keeps `before` if `with_before` is
/// set. An exception of `check` ends it.
FilledTake fill_take(const FillRun& run, const TakeJob& job, bool with_before,
                     const FillCheck& check = {});
/// The curves by which every method would fill one gap of the first take, chosen by its row of the
/// plan. Errors: those of `fill_take`; `ErrorKind::usage` for a run without a plan.
GapCurves gap_curves(const FillRun& run, std::size_t row, const FillCheck& check);

}  // namespace kinemend::cli
