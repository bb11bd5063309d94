// The plan of a `clean` or `batch` run: which takes, which method and which settings.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "config.hpp"
#include "frame_range.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/experimental/page.hpp"
#include "kinemend/io.hpp"
#include "page_report.hpp"
#include "run_files.hpp"
#include "take_jobs.hpp"

namespace kinemend::cli {

/// All that `clean` was asked for, checked.
struct CleanPlan {
  TakeJobs takes;
  std::string method;
  OptionValues options;  ///< every option of the method with its value
  std::unique_ptr<Cleaner> cleaner;
  std::string preset_note{};  ///< that the preset chose another method than the default; else empty
  CleanSettings settings;
  std::optional<FrameRange> range;
  ReadOptions reading;
  /// Of --gaps and --contacts: bytes and name. Names and frames are those of a take.
  std::optional<std::pair<std::string, std::string>> gaps, contacts;
  bool fix_swaps = false;
  bool cleans = true;  ///< false in a `batch --no-clean`, whose cleaner does nothing
  /// The format of the results of `batch`; null: each result has the format of its input.
  const Format* to = nullptr;
  bool all_takes = false;              ///< of `clean`: every take of a file that holds several
  std::vector<std::string> asked{};    ///< of `clean`: flags that the command line itself gives
  ReportFiles reports{};               ///< of `clean`
  std::optional<PageSettings> page{};  ///< where a page is made of each take
  std::function<void(const Take&)> on_read{};  ///< told of each take before it is cleaned
  bool strict = false;
  bool force = false;
  bool dry_run = false;
  bool json = false;
  bool verbose = false;
  bool quiet = false;
  int threads = 0;  ///< 0: as many as there are cores
};

/// Defaults, under the preset, under the configuration file, under the command line.
Settings merged_settings(const Arguments& arguments);
/// How to clean, without what and where to: what `clean` and `batch` share. Errors:
/// `ErrorKind::usage`.
CleanPlan make_cleaning(const Arguments& arguments);
/// The files that the cleaning itself reads, for `RunFiles::check`: settings, gaps, skeleton,
/// noise, model, map. `clean` and `batch` add their takes and outputs.
RunFiles files_read(const CleanPlan& plan, const Arguments& arguments);
/// The plan of `clean`. Errors: `ErrorKind::usage`.
CleanPlan make_clean_plan(const Arguments& arguments);

}  // namespace kinemend::cli
