// kinemend clean: reads takes, cleans them, writes them, says what was done.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>

#include "clean_plan.hpp"
#include "clean_report.hpp"
#include "commands.hpp"
#include "json.hpp"
#include "kinemend/io.hpp"
#include "kinemend/version.hpp"
#include "method_options.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// What is left of a take when it is done: text, not motion, so that any number of takes fits.
struct Outcome {
  int code = 0;
  std::string text;
  std::vector<std::string> warnings;
  std::string error;
  std::shared_ptr<const Json> json;    ///< entry of --json; null when not asked for
  std::shared_ptr<const Json> report;  ///< entry of --report
};

void write_result(const CleanJob& job, const Clip& clip, const CleanPlan& plan) {
  const Format* named = job.output == "-" ? nullptr : format_of_path(job.output);
  const std::string_view format = named ? named->name : std::string_view(clip.source.format);
  const std::string bytes = write_clip(clip, format);
  std::error_code error;
  if (!plan.folder.empty()) fs::create_directories(plan.folder, error);
  if (error)
    throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", plan.folder, error.message()));
  write_output(job.output, bytes, plan.force);
}

void refuse_warnings(const std::string& name, const CleanReport& report) {
  if (report.warnings.empty()) return;
  throw Error(ErrorKind::quality_limit,
              fmt::format("{}: {} (an error under --strict)", name, report.warnings.front()));
}

void clean_take(const CleanJob& job, const CleanPlan& plan, Outcome& outcome) {
  const std::string name = input_name(job.input);
  if (!plan.dry_run) check_free(job.output, plan.force);
  ReadOptions options;
  options.format = plan.format;
  options.strict = plan.strict;
  ReadResult take = read_clip(fs::path(job.input), options);
  for (const Diagnostic& entry : take.diagnostics.entries())
    outcome.warnings.push_back(diagnostic_line(name, entry));
  CleanSettings settings = plan.settings;
  if (plan.range) settings.range = frames_of(*plan.range, take.clip);
  const CleanResult result = tbb::this_task_arena::isolate(
      [&] { return clean_clip(take.clip, *plan.cleaner, settings, plan.method); });
  if (plan.strict) refuse_warnings(name, result.report);
  for (const std::string& warning : result.report.warnings)
    outcome.warnings.push_back(fmt::format("{}: {}", name, warning));
  if (!plan.dry_run) write_result(job, result.clip, plan);
  const bool is_only = plan.jobs.size() == 1;
  outcome.text = headline(job, result.report, plan, Colours::of_out());
  if (is_only || plan.verbose) outcome.text += report_text(result.report, plan.verbose);
  const auto entry = [&](bool with_spans) {
    return std::make_shared<const Json>(
        report_json(job, result.report, take.diagnostics, plan, with_spans));
  };
  if (plan.json) outcome.json = entry(false);
  if (!plan.report_path.empty()) outcome.report = entry(true);
}

Outcome try_take(const CleanJob& job, const CleanPlan& plan) {
  Outcome outcome;
  try {
    clean_take(job, plan, outcome);
    return outcome;
  } catch (const Error& error) {
    outcome.code = static_cast<int>(error.kind());
    outcome.error = error.what();
    // What the library says of settings does not name the take.
    if (error.kind() == ErrorKind::usage)
      outcome.error = fmt::format("{}: {}", input_name(job.input), error.what());
  } catch (const std::bad_alloc&) {
    outcome.code = static_cast<int>(ErrorKind::unreadable_input);
    outcome.error = input_name(job.input) + ": out of memory";
  }
  outcome.json = outcome.report = std::make_shared<const Json>(
      Json{{"input", job.input}, {"error", outcome.error}, {"exit_code", outcome.code}});
  return outcome;
}

/// Says of each take what happened, in the order of the command line, as soon as it is its turn.
class Announcer {
 public:
  explicit Announcer(const CleanPlan& plan)
      : plan_(plan), outcomes_(plan.jobs.size()), bar_(plan.jobs.size()) {
    bool stdout_is_taken = plan.report_path == "-";
    for (const CleanJob& job : plan.jobs) stdout_is_taken |= job.output == "-" && !plan.dry_run;
    to_stderr_ = stdout_is_taken;
  }

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
    Json files = Json::array();
    Json reports = Json::array();
    for (std::optional<Outcome>& outcome : outcomes_) {
      code = std::max(code, outcome->code);
      failed += outcome->code != 0 ? 1 : 0;
      if (outcome->json) files.push_back(*outcome->json);
      if (outcome->report) reports.push_back(*outcome->report);
    }
    if (outcomes_.size() > 1 && failed > 0)
      say_error(fmt::format("{} of {} failed", failed, counted(outcomes_.size(), "take")));
    if (plan_.json) write_out(json_text({{"kinemend", version()}, {"takes", std::move(files)}}));
    // Bad input leaves nothing behind; a dry run writes no file.
    const bool is_wanted = plan_.report_path == "-" || !plan_.dry_run;
    if (!plan_.report_path.empty() && is_wanted && failed < outcomes_.size()) {
      write_output(plan_.report_path,
                   json_text({{"kinemend", version()}, {"takes", std::move(reports)}}),
                   plan_.force);
    }
    if (stdout_is_closed_) throw ClosedPipe();
    return code;
  }

 private:
  void announce(const Outcome& outcome) {
    bar_.clear();
    for (const std::string& warning : outcome.warnings) say_warning(warning);
    if (!outcome.error.empty()) say_error(outcome.error);
    if (plan_.quiet || plan_.json || stdout_is_closed_) return;
    if (to_stderr_) return write_err(outcome.text);
    try {
      write_out(outcome.text);
    } catch (const ClosedPipe&) {
      // The takes are still to be written.
      stdout_is_closed_ = true;
    }
  }

  const CleanPlan& plan_;
  std::vector<std::optional<Outcome>> outcomes_;
  ProgressBar bar_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  bool to_stderr_ = false;
  bool stdout_is_closed_ = false;
};

void clean_all(const CleanPlan& plan, Announcer& announcer) {
  std::optional<tbb::global_control> limit;
  if (plan.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<std::size_t>(plan.threads));
  }
  if (plan.jobs.size() == 1) return announcer.take(0, try_take(plan.jobs[0], plan));
  // Each worker takes the next job in order, so that the first takes are announced first.
  const int workers = tbb::this_task_arena::max_concurrency();
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(0, workers, [&](int) {
    for (std::size_t i = next++; i < plan.jobs.size(); i = next++)
      announcer.take(i, try_take(plan.jobs[i], plan));
  });
}

int print_config(const Arguments& arguments) {
  const Settings settings = merged_settings(arguments);
  std::string heading =
      "Settings of `kinemend clean --config FILE`. What is left out has the default; the command "
      "line goes over this file, this file over --preset.";
  const std::string preset = arguments.text("preset");
  if (!preset.empty())
    heading += fmt::format(" Preset {}: {}", preset, preset_summary(find_preset(preset)));
  write_out(settings_text(*arguments.command, settings, heading));
  return 0;
}

int run(const Arguments& arguments) {
  if (arguments.flag("print_config")) return print_config(arguments);
  if (arguments.positionals.empty())
    throw Error(ErrorKind::usage, "clean: IN is missing (see kinemend clean -h)");
  const CleanPlan plan = make_clean_plan(arguments);
  if (!plan.report_path.empty() && !plan.dry_run) check_free(plan.report_path, plan.force);
  Announcer announcer(plan);
  clean_all(plan, announcer);
  return announcer.finish();
}

Flag configurable(Flag flag) {
  flag.configurable = true;
  return flag;
}

Flag list_flag(std::string name, std::string help, std::string details) {
  Flag flag = text_flag(std::move(name), "A,B,...", "Where", std::move(help), std::move(details));
  flag.takes = Takes::list;
  return configurable(flag);
}

Flag method_flag() {
  Flag flag =
      text_flag("method", "NAME", "Cleaning", "how to clean; kinemend methods tells of each",
                "The options of each method are valid with that method only.");
  flag.spec.default_value = std::string("auto");
  flag.spec.choices = method_names();
  flag.has_default = true;
  return configurable(flag);
}

Flag preset_flag() {
  Flag flag = text_flag("preset", "", "Cleaning", "settings for a kind of motion");
  std::vector<std::string> summaries;
  for (const Preset& preset : presets()) {
    flag.spec.choices.emplace_back(preset.name);
    summaries.push_back(fmt::format("{} ({})", preset.name, preset_summary(preset)));
  }
  flag.details = fmt::format("Goes under --config and the command line. There are {}.",
                             fmt::join(summaries, "; "));
  return flag;
}

Flag file_flag(std::string name, std::string value, std::string group, std::string help,
               std::string details = {}, Completion completion = Completion::file) {
  Flag flag = text_flag(std::move(name), std::move(value), std::move(group), std::move(help),
                        std::move(details));
  flag.completion = completion;
  return flag;
}

Flag root_position_flag() {
  Flag flag = switch_flag("root_position", "Where", "also clean the root's path");
  flag.spec.default_value = true;
  return configurable(flag);
}

std::vector<Flag> flags() {
  std::vector<Flag> list = {
      output_flag("where to write one take; - is standard output"),
      file_flag("output_dir", "DIR", "Output", "folder for the results, under the inputs' names",
                "It is made where it does not exist. Several takes are cleaned in parallel.",
                Completion::folder),
      force_flag(),
      switch_flag("dry_run", "Output", "clean and report, but write nothing"),
      file_flag("report", "FILE", "Output", "write what was done to each span of samples, as JSON"),
      json_flag("print the summary as JSON instead of text"),
      switch_flag("verbose", "Output", "list every joint that changed"),
      switch_flag("quiet", "Output", "print warnings and errors only"),
      method_flag(),
      configurable(number_flag("strength", "", 1, 0, 1, "Cleaning",
                               "how far to go from the input (0) to the cleaned motion (1)",
                               "Typical: 0.5 to 1.")),
      configurable(number_flag("max_change_deg", "deg", 180, 0, 180, "Cleaning",
                               "no sample turns further than this from its input",
                               "Typical: 5 to 30 against jitter alone; spikes need more.")),
      configurable(number_flag("peak_loss_limit", "", 0.1, 0, 1, "Cleaning",
                               "share of a joint's peak speed that may go without a warning",
                               "Typical: 0.05 for impacts to 0.2 for slow motion.")),
      preset_flag(),
      file_flag("config", "FILE", "Cleaning", "settings from a TOML file, over those of --preset"),
      switch_flag("print_config", "Cleaning",
                  "print the settings as a TOML file with comments, and stop"),
      list_flag("joints", "joints that may change (default all)",
                "Names or patterns in which * is any text and ? any character; quote them."),
      list_flag("exclude", "joints that may not change after all", "Written like --joints."),
      root_position_flag(),
      text_flag(
          "range", "FIRST:LAST", "Where",
          "what may change: frames 121:240, counted from 1, or seconds 1s:2.5s",
          "Either end may be left out. The method sees all of the take; the result is blended "
          "in over 0.1 s."),
      from_flag(),
      configurable(strict_flag("what needs a repair or a warning becomes an error")),
      seed_flag("seed of the methods that draw random numbers"),
      whole_flag("jobs", 0, 0, 1024, "Work", "threads; 0: as many as there are cores",
                 "The result does not depend on it.")};
  for (Flag& flag : list) {
    if (flag.spec.name == "verbose") flag.letter = 'v';
    if (flag.spec.name == "quiet") flag.letter = 'q';
    if (flag.spec.name == "method") flag.letter = 'm';
    if (flag.spec.name == "jobs") flag.letter = 'j';
  }
  return list;
}

}  // namespace

Command clean_command() {
  Command command;
  command.name = "clean";
  command.summary = "clean takes: jitter, spikes, gaps";
  command.description =
      "Reads each take, cleans its rotations and its root position, and writes it back in its own "
      "format and layout: what no step changed keeps its digits. Without --output and --output-dir "
      "the result of walk.bvh is walk.clean.bvh beside it; that of standard input (-) goes to "
      "standard output.\n\n"
      "The report goes to standard output, or to standard error where standard output holds the "
      "take. Warnings and errors go to standard error. A take that cannot be read stops none of "
      "the "
      "others; the exit code is the highest of all.";
  command.positionals = {{"IN", "take to clean; - is standard input", 0, 1000000, {}}};
  command.flags = flags();
  command.group_heading = "With --method %";
  command.groups = method_groups();
  command.groups_are_flags = true;
  command.examples = {
      {"kinemend clean walk.bvh", "writes walk.clean.bvh with the default method"},
      {"kinemend clean walk.bvh --method butterworth --cutoff-hz 6 -o smooth.bvh",
       "one method with one of its options"},
      {"kinemend clean *.bvh --output-dir clean --preset sport", "many takes in parallel"},
      {"kinemend clean take.bvh --joints 'Left*' --exclude LeftHand --range 2s:5s",
       "part of the body, part of the time"},
      {"kinemend clean - < in.bvh > out.bvh", "in a pipeline"},
      {"kinemend clean --preset biomech --print-config > lab.toml",
       "a file of settings to keep and change"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
