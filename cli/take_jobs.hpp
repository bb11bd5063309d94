// The takes of a command that takes many: where each result goes, and the run over all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "kinemend/experimental/batch_rows.hpp"
#include "kinemend/io.hpp"
#include "page_report.hpp"

namespace kinemend::cli {

/// One take on its way.
struct TakeJob {
  std::string input;
  std::string output;
  bool may_replace = false;  ///< also without --force
  std::string row_name{};    ///< of its row in a batch; empty: none is made
};

/// The takes of a run.
struct TakeJobs {
  std::vector<TakeJob> jobs;
  std::string folder;                ///< for the results, under the inputs' names; empty: none
  std::vector<std::string> skipped;  ///< inputs that an earlier run wrote
};

/// How results are named.
struct ResultNames {
  std::string word;            ///< walk.WORD.bvh beside walk.bvh; empty: walk.bvh
  const Format* to = nullptr;  ///< format of the results; null: that of each input
};

/// Plans the results of `inputs`: --output names a file, or a folder if it exists as one or ends in
/// a slash; --output-dir names a folder; without both, results go beside their inputs.
///
/// Among several inputs, the results of an earlier run are left out: names that end in .WORD.EXT,
/// or that are the names of other results. If all inputs are such results, none is left out.
///
/// Errors: `ErrorKind::usage` for options that contradict each other and for two inputs with one
/// result; `ErrorKind::cannot_write` for a folder that cannot be made.
TakeJobs plan_take_jobs(const Arguments& arguments, const std::vector<std::string>& inputs,
                        const ResultNames& names);

/// --output-dir.
Flag output_dir_flag();
/// The option that names the results, for messages: "--output" or "--output-dir".
const char* result_option(const TakeJobs& takes);

/// Throws for an input that is a directory; `words` follow its name in a command that takes
/// directories. Errors: `ErrorKind::unreadable_input`.
void refuse_folder(const std::string& input, std::string_view what, std::string_view words);
/// Refuses a result that exists, or whose folder is missing, before work is spent on it. Errors:
/// `ErrorKind::cannot_write`.
void check_result(const TakeJob& job, const TakeJobs& takes, bool force);
/// Makes the folder for the results if there is to be one, and writes the take.
void write_result(const TakeJob& job, const TakeJobs& takes, const Take& take,
                  const std::string& format, bool force);

/// What remains of a take when it is done: text, not motion, so that any number of takes fits.
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

/// Calls `work`, and turns what it throws into the code, the error and the entries of an outcome,
/// without the text: a result that could not be written was not written. `with_name`: errors of the
/// kind `usage`, which do not always name the take, get its name in front.
Outcome outcome_of(const std::string& input, bool with_name,
                   const std::function<void(Outcome&)>& work);

/// Told what is being done with a take and how far it is (0..1).
using TakeProgress = std::function<void(std::string_view stage, double done)>;

/// What `run_take_jobs` needs to know of a command.
struct TakeRun {
  std::string command;
  const ReportFiles& reports;
  bool out_is_taken = false;  ///< standard output holds something else than what is printed
  bool quiet = false;
  bool json = false;
  bool force = false;
  int threads = 0;  ///< 0: as many as there are cores
};

/// Does all jobs, in parallel where there are several, with a progress bar. What became of each is
/// said in the order of the command line, as soon as it is its turn. Then writes the reports.
/// Returns the highest exit code.
int run_take_jobs(const TakeJobs& takes, const TakeRun& run,
                  const std::function<Outcome(const TakeJob&, const TakeProgress&)>& work);

}  // namespace kinemend::cli
