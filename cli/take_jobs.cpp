// Names results after their inputs, leaves out results of an earlier run, and runs jobs on all
// cores while it reports them in order.
#include "take_jobs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// "new/" is a folder that need not exist yet.
bool names_folder(const std::string& output) {
  std::error_code ignored;
  return !output.empty() && (output.back() == '/' || fs::is_directory(output, ignored));
}

/// Returns the folder that the options name; empty if they name no folder.
std::string folder_of(const Arguments& arguments, std::size_t inputs) {
  const std::string& command = arguments.command->name;
  std::string output = arguments.text("output"), folder = arguments.text("output_dir");
  if (!output.empty() && !folder.empty())
    throw Error(ErrorKind::usage,
                fmt::format("{}: --output and --output-dir cannot be combined", command));
  if (output.empty()) return folder;
  if (names_folder(output)) return output;
  if (inputs > 1) {
    throw Error(ErrorKind::usage,
                fmt::format("{0}: --output {1} is a file for one take, and there are {2}; "
                            "--output-dir {1} writes them into a folder",
                            command, output, inputs));
  }
  return "";
}

std::string named_after(const std::string& input, const std::string& folder,
                        const ResultNames& names, const std::string& from) {
  const auto in_format = [&](const fs::path& path) {
    return fs::path(path).replace_extension(names.to->extensions.front()).string();
  };
  if (!folder.empty()) {
    const fs::path path = fs::path(folder) / fs::path(input).filename();
    return names.to != nullptr ? in_format(path) : with_right_ending(path.string(), input, from);
  }
  if (names.to == nullptr) return output_beside(input, names.word, from);
  return is_stream(input) ? "-" : in_format(input);
}

std::string plain_path(const std::string& path) {
  return fs::path(path).lexically_normal().string();
}

bool has_word(const std::string& input, const std::string& word) {
  return !word.empty() && fs::path(input).stem().extension() == "." + word;
}

/// Removes the results of an earlier run from `inputs` and returns them.
std::vector<std::string> take_earlier_results(std::vector<std::string>& inputs,
                                              const std::string& folder, const ResultNames& names,
                                              const std::string& from) {
  if (inputs.size() < 2) return {};
  std::map<std::string, std::string> results;
  for (const std::string& input : inputs)
    results.emplace(plain_path(named_after(input, folder, names, from)), input);
  const auto is_earlier = [&](const std::string& input) {
    if (is_stream(input)) return false;
    const auto found = results.find(plain_path(input));
    return has_word(input, names.word) ||
           (found != results.end() && plain_path(found->second) != plain_path(input));
  };
  const auto first = std::stable_partition(inputs.begin(), inputs.end(),
                                           [&](const auto& input) { return !is_earlier(input); });
  if (first == inputs.begin()) return {};
  std::vector<std::string> skipped(first, inputs.end());
  inputs.erase(first, inputs.end());
  return skipped;
}

/// Refuses a result folder below a file, before work is spent.
void check_can_make(const fs::path& folder) {
  std::error_code error;
  for (fs::path path = folder; !path.empty(); path = path.parent_path()) {
    if (fs::is_directory(path, error)) return;
    if (fs::exists(path, error)) {
      throw Error(ErrorKind::cannot_write, fmt::format("{}: Not a directory", folder.string()));
    }
    if (path == path.parent_path()) return;
  }
}

/// Reports on each take in the order of the command line, as early as possible.
class Announcer {
 public:
  Announcer(const TakeJobs& takes, const TakeRun& run)
      : run_(run), outcomes_(takes.jobs.size()), bar_(takes.jobs.size()) {}

  void take(std::size_t index, Outcome outcome) {
    {
      const std::lock_guard lock(mutex_);
      outcomes_[index] = std::move(outcome);
      while (next_ < outcomes_.size() && outcomes_[next_]) announce(*outcomes_[next_++]);
    }
    bar_.step();
  }

  /// The highest exit code of all takes.
  int finish() {
    bar_.clear();
    int code = 0;
    std::size_t failed = 0;
    std::vector<std::string> files, reports;
    bool has_report = false;
    for (std::optional<Outcome>& outcome : outcomes_) {
      code = std::max(code, outcome->code);
      failed += outcome->code != 0 ? 1 : 0;
      has_report |= outcome->has_report;
      files.push_back(std::move(outcome->json));
      reports.push_back(std::move(outcome->report));
    }
    if (outcomes_.size() > 1 && failed > 0)
      say_error(fmt::format("{} of {} failed", failed, counted(outcomes_.size(), "take")));
    if (run_.json) write_out(report_document(run_.command, files));
    // If every input fails, no report is written.
    ReportFiles written = run_.reports;
    if (failed == outcomes_.size())
      std::erase_if(written.paths, [&](const auto& path) { return !has_report || path != "-"; });
    if (!written.empty()) {
      written.write(report_document(run_.command, reports), outcomes_.front()->page, run_.force);
    }
    if (stdout_is_closed_) throw ClosedPipe();
    return code;
  }

 private:
  void announce(const Outcome& outcome) {
    bar_.clear();
    for (const std::string& note : outcome.notes) {
      if (!run_.quiet) say(note);
    }
    for (const std::string& warning : outcome.warnings) say_warning(warning);
    if (!outcome.error.empty()) say_error(outcome.error);
    if (run_.quiet || run_.json || stdout_is_closed_ || outcome.text.empty()) return;
    if (run_.out_is_taken) return write_err(outcome.text);
    try {
      write_out(outcome.text);
    } catch (const ClosedPipe&) {
      // The remaining takes are still written.
      stdout_is_closed_ = true;
    }
  }

  const TakeRun& run_;
  std::vector<std::optional<Outcome>> outcomes_;
  ProgressBar bar_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  bool stdout_is_closed_ = false;
};

void say_skipped(const std::vector<std::string>& skipped) {
  if (skipped.empty()) return;
  constexpr std::size_t most = 3;
  const std::size_t shown = std::min(most, skipped.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < shown; ++i) names.push_back(printable(skipped[i]));
  say(fmt::format("skipped {} of an earlier run: {}{}", counted(skipped.size(), "result"),
                  fmt::join(names, ", "),
                  skipped.size() > shown ? fmt::format(" and {} more", skipped.size() - shown)
                                         : std::string()));
}

}  // namespace

TakeJobs plan_take_jobs(const Arguments& arguments, const std::vector<std::string>& inputs,
                        const ResultNames& names) {
  const std::string& command = arguments.command->name;
  const std::string from = arguments.text("from");
  TakeJobs takes;
  takes.folder = folder_of(arguments, inputs.size());
  const std::string output = takes.folder.empty() ? arguments.text("output") : std::string();
  std::vector<std::string> chosen = inputs;
  takes.skipped = take_earlier_results(chosen, takes.folder, names, from);
  ResultPaths results(command);
  for (const std::string& input : chosen) {
    if (is_stream(input) && !takes.folder.empty())
      throw Error(ErrorKind::usage, fmt::format("{}: standard input has no name for {}", command,
                                                result_option(takes)));
    const std::string target =
        output.empty() ? named_after(input, takes.folder, names, from) : output;
    results.add(target, input);
    takes.jobs.push_back({input, target, false});
  }
  if (!takes.folder.empty()) check_can_make(takes.folder);
  return takes;
}

Flag output_dir_flag() {
  return file_flag("output_dir", "DIR", "Output", "folder for the results, under the inputs' names",
                   "Created if it does not exist. Several takes are worked on in parallel.",
                   Completion::folder);
}

const char* result_option(const TakeJobs& takes) {
  return takes.folder.empty() ? "--output" : "--output-dir";
}

void refuse_folder(const std::string& input, std::string_view what, std::string_view words) {
  std::error_code ignored;
  if (!fs::is_directory(input, ignored)) return;
  throw Error(ErrorKind::unreadable_input,
              fmt::format("{0}: this is a directory; to {1} a tree of takes use: kinemend batch "
                          "{0} -o OUT{2}",
                          input, what, words));
}

void check_result(const TakeJob& job, const TakeJobs& takes, bool force) {
  const bool may_replace = force || job.may_replace;
  // The folder of several results is created when the first one is written.
  if (takes.folder.empty() && job.row_name.empty()) return check_free(job.output, may_replace);
  check_not_there(job.output, may_replace);
}

void write_result(const TakeJob& job, const TakeJobs& takes, const Take& take,
                  const std::string& format, bool force) {
  std::error_code error;
  if (!takes.folder.empty()) fs::create_directories(takes.folder, error);
  if (error)
    throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", takes.folder, error.message()));
  write_take_output(job.output, take, format, force || job.may_replace);
}

Outcome outcome_of(const std::string& input, bool with_name,
                   const std::function<void(Outcome&)>& work) {
  Outcome outcome;
  try {
    work(outcome);
    return outcome;
  } catch (const Error& error) {
    outcome.code = static_cast<int>(error.kind());
    outcome.error = error.what();
    if (with_name && error.kind() == ErrorKind::usage &&
        !outcome.error.starts_with(input_name(input)))
      outcome.error = fmt::format("{}: {}", input_name(input), error.what());
  } catch (const std::bad_alloc&) {
    outcome.code = static_cast<int>(ErrorKind::unreadable_input);
    outcome.error = input_name(input) + ": out of memory";
  } catch (const std::exception& error) {
    outcome.code = static_cast<int>(ErrorKind::unreadable_input);
    outcome.error = fmt::format("{}: internal error: {}", input_name(input), error.what());
  }
  outcome.text.clear();
  outcome.has_report = false;
  outcome.json = outcome.report = failure_json(input, outcome.error, outcome.code);
  return outcome;
}

int run_take_jobs(const TakeJobs& takes, const TakeRun& run,
                  const std::function<Outcome(const TakeJob&, const TakeProgress&)>& work) {
  if (!run.quiet) say_skipped(takes.skipped);
  std::optional<ThreadLimit> limit;
  if (run.threads > 0) limit.emplace(static_cast<std::size_t>(run.threads));
  Announcer announcer(takes, run);
  if (takes.jobs.size() == 1) {
    Outcome outcome;
    {
      LateProgressLine line(!run.quiet);
      outcome =
          work(takes.jobs[0], [&](std::string_view stage, double done) { line.show(stage, done); });
    }
    announcer.take(0, std::move(outcome));
    return announcer.finish();
  }
  // Workers take jobs in order, so that the first takes are reported first.
  std::atomic<std::size_t> next{0};
  on_every_thread([&] {
    for (std::size_t i = next++; i < takes.jobs.size(); i = next++)
      announcer.take(i, work(takes.jobs[i], {}));
  });
  return announcer.finish();
}

}  // namespace kinemend::cli
