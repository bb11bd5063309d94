// The plan of a `clean` or `batch` run: its takes, method and settings.
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
#include "kinemend/extend/pages.hpp"
#include "kinemend/io.hpp"
#include "page_report.hpp"
#include "run_files.hpp"
#include "take_jobs.hpp"

namespace kinemend::cli {

/// The checked request of a `clean` run.
struct CleanPlan {
  TakeJobs takes;
  std::string method;
  OptionValues options;  ///< every option of the method with its value
  std::unique_ptr<Cleaner> cleaner;
  std::string preset_note{};  ///< set if the preset chose another method than the default
  CleanSettings settings;
  std::optional<FrameRange> range;
  ReadOptions reading;
  /// Bytes and name of the files of --gaps and --contacts; names and frames are checked per take.
  std::optional<std::pair<std::string, std::string>> gaps, contacts;
  bool cleans = true;  ///< false in a `batch --no-clean`, whose cleaner does nothing
  /// The format of the results of `batch`; null: each result has the format of its input.
  const Format* to = nullptr;
  bool all_takes = false;  ///< `clean` only: cleans every take of a file that holds several
  std::vector<std::string> asked{};    ///< `clean` only: flags given on the command line itself
  ReportFiles reports{};               ///< `clean` only
  std::optional<PageSettings> page{};  ///< set if each take gets a page
  std::function<void(const Take&)> on_read{};  ///< called with each take before cleaning
  bool strict = false;
  bool force = false;
  bool dry_run = false;
  bool json = false;
  bool verbose = false;
  bool quiet = false;
  int threads = 0;  ///< 0: one per core
};

/// Merges the defaults, the preset, the configuration file and the command line, in rising
/// priority.
Settings merged_settings(const Arguments& arguments);
/// The cleaning part of a plan, without inputs and outputs, shared by `clean` and `batch`. Errors:
/// `ErrorKind::usage`.
CleanPlan make_cleaning(const Arguments& arguments);
/// The files that the cleaning itself reads, for `RunFiles::check`: settings, gaps, skeleton,
/// noise, model, map. `clean` and `batch` add their takes and outputs.
RunFiles files_read(const CleanPlan& plan, const Arguments& arguments);
/// The plan of `clean`. Errors: `ErrorKind::usage`.
CleanPlan make_clean_plan(const Arguments& arguments);

}  // namespace kinemend::cli
