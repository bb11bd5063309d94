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

namespace kinemend::cli {

/// One take on its way.
struct CleanJob {
  std::string input;
  std::string output;
  bool may_replace = false;  ///< also without --force
  std::string row_name{};    ///< of its row in a batch; empty: none is made
};

/// All that `clean` was asked for, checked.
struct CleanPlan {
  std::vector<CleanJob> jobs;
  std::string method;
  OptionValues options;  ///< every option of the method with its value
  std::unique_ptr<Cleaner> cleaner;
  CleanSettings settings;
  std::optional<FrameRange> range;
  ReadOptions reading;
  /// Of --gaps and --contacts: bytes and name. Names and frames are those of a take.
  std::optional<std::pair<std::string, std::string>> gaps, contacts;
  bool fix_swaps = false;
  bool all_takes = false;              ///< of `clean`: every take of a file that holds several
  std::vector<std::string> asked{};    ///< of `clean`: flags that the command line itself gives
  std::string folder;                  ///< --output-dir; made where it does not exist
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
