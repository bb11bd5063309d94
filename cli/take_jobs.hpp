// Commands on many takes: where each result goes, and the run over all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/io.hpp"
#include "page_report.hpp"

namespace kinemend::cli {

/// One take to process.
struct TakeJob {
  std::string input;
  std::string output;
  bool may_replace = false;  ///< may replace an existing file even without --force
  std::string row_name{};    ///< name of its row in a batch; empty: no row
};

/// The takes of a run.
struct TakeJobs {
  std::vector<TakeJob> jobs;
  std::string folder;                ///< for results under their inputs' names; empty: none
  std::vector<std::string> skipped;  ///< inputs that are results of an earlier run
};

/// How results are named.
struct ResultNames {
  std::string word;            ///< walk.WORD.bvh beside walk.bvh; empty: walk.bvh
  const Format* to = nullptr;  ///< format of the results; null: that of each input
};

/// Plans the results of `inputs`: --output names a file, or a folder if it exists as one or ends in
/// a slash; --output-dir names a folder; without both, results go beside their inputs.
///
/// Among several inputs, results of an earlier run are left out: names that end in .WORD.EXT or
/// equal other results. If all inputs are such results, all are used.
///
/// Errors: `ErrorKind::usage` for options that contradict each other and for two inputs with one
/// result; `ErrorKind::cannot_write` for a folder that cannot be made.
TakeJobs plan_take_jobs(const Arguments& arguments, const std::vector<std::string>& inputs,
                        const ResultNames& names);

/// --output-dir.
Flag output_dir_flag();
/// The option that names the results, for messages: "--output" or "--output-dir".
const char* result_option(const TakeJobs& takes);

/// Throws if an input is a directory; `words` follow its name if the command accepts directories.
/// Errors: `ErrorKind::unreadable_input`.
void refuse_folder(const std::string& input, std::string_view what, std::string_view words);
/// Refuses a result that exists or whose folder is missing, before work is spent. Errors:
/// `ErrorKind::cannot_write`.
void check_result(const TakeJob& job, const TakeJobs& takes, bool force);
/// Makes the folder for the results if needed, and writes the take.
void write_result(const TakeJob& job, const TakeJobs& takes, const Take& take,
                  const std::string& format, bool force);

/// The output of a processed take: text but no motion, so that memory does not grow with the takes.
struct Outcome {
  int code = 0;
  std::string text;
  std::vector<std::string> notes;  ///< for standard error, before the warnings
  std::vector<std::string> warnings;
  std::string error;
  bool has_report = true;       ///< false for a take that could not be read or written
  std::string json;             ///< entry of --json; empty when not asked for
  std::string report;           ///< entry of a --report that is JSON
  std::string page;             ///< for a --report that is a page
  std::string picture;          ///< SVG of a few poses, for the index of a batch with pages
  std::optional<BatchRow> row;  ///< of `TakeJob::row_name`
};

/// Calls `work` and converts an exception to the code, error and entries of an outcome, without its
/// text, because the result was not written. `with_name` adds the name of the take to errors of the
/// kind `usage`, which do not always have it.
Outcome outcome_of(const std::string& input, bool with_name,
                   const std::function<void(Outcome&)>& work);

/// Receives the current stage of a take and its progress (0..1).
using TakeProgress = std::function<void(std::string_view stage, double done)>;

/// The settings of `run_take_jobs` for a command.
struct TakeRun {
  std::string command;
  const ReportFiles& reports;
  bool out_is_taken = false;  ///< standard output holds a result instead of messages
  bool quiet = false;
  bool json = false;
  bool force = false;
  int threads = 0;  ///< 0: one per core
};

/// Runs all jobs, in parallel if there are several, with a progress bar. Reports on each in the
/// order of the command line, as early as possible. Then writes the reports. Returns the highest
/// exit code.
int run_take_jobs(const TakeJobs& takes, const TakeRun& run,
                  const std::function<Outcome(const TakeJob&, const TakeProgress&)>& work);

}  // namespace kinemend::cli
