// kinemend clean: reads takes, cleans them, writes them, says what was done.

#include <fmt/format.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "clean_flags.hpp"
#include "clean_plan.hpp"
#include "clean_take.hpp"
#include "commands.hpp"
#include "kinemend/experimental/threads.hpp"
#include "kinemend/report.hpp"
#include "method_options.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

/// Says of each take what happened, in the order of the command line, as soon as it is its turn.
class Announcer {
 public:
  explicit Announcer(const CleanPlan& plan)
      : plan_(plan), outcomes_(plan.jobs.size()), bar_(plan.jobs.size()) {
    bool stdout_is_taken = plan.reports.on_out();
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
    std::vector<std::string> files, reports;
    for (std::optional<Outcome>& outcome : outcomes_) {
      code = std::max(code, outcome->code);
      failed += outcome->code != 0 ? 1 : 0;
      files.push_back(std::move(outcome->json));
      reports.push_back(std::move(outcome->report));
    }
    if (outcomes_.size() > 1 && failed > 0)
      say_error(fmt::format("{} of {} failed", failed, counted(outcomes_.size(), "take")));
    if (plan_.json) write_out(report_document("clean", files));
    // Bad input leaves nothing behind.
    if (!plan_.reports.empty() && failed < outcomes_.size()) {
      plan_.reports.write(report_document("clean", reports), outcomes_.front()->page, plan_.force);
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
  std::optional<ThreadLimit> limit;
  if (plan.threads > 0) limit.emplace(static_cast<std::size_t>(plan.threads));
  if (plan.jobs.size() == 1) {
    Outcome outcome;
    {
      LateProgressLine line(!plan.quiet);
      outcome = try_take(plan.jobs[0], plan,
                         [&](std::string_view stage, double done) { line.show(stage, done); });
    }
    return announcer.take(0, std::move(outcome));
  }
  // Each worker takes the next job in order, so that the first takes are announced first.
  std::atomic<std::size_t> next{0};
  on_every_thread([&] {
    for (std::size_t i = next++; i < plan.jobs.size(); i = next++)
      announcer.take(i, try_take(plan.jobs[i], plan));
  });
}

int print_config(const Arguments& arguments) {
  const Settings settings = merged_settings(arguments);
  std::string heading =
      "Settings of `kinemend clean --config FILE`. A setting that is left out has its default. The "
      "command line overrides this file, and this file overrides --preset.";
  const std::string preset = arguments.text("preset");
  if (!preset.empty())
    heading += fmt::format(" Preset {}: {}", preset, preset_summary(find_preset(preset)));
  write_out(settings_text(*arguments.command, settings, heading));
  return 0;
}

int run_clean(const Arguments& arguments) {
  if (arguments.flag("print_config")) return print_config(arguments);
  if (arguments.positionals.empty())
    throw Error(ErrorKind::usage, "clean: IN is missing (see kinemend clean -h)");
  const CleanPlan plan = make_clean_plan(arguments);
  plan.reports.check_free(plan.force);
  Announcer announcer(plan);
  clean_all(plan, announcer);
  return announcer.finish();
}

}  // namespace

Command clean_command() {
  Command command;
  command.name = "clean";
  command.summary = "clean takes: jitter, spikes, gaps";
  command.description =
      "Reads each take, cleans its rotations and its root position, or its markers, and writes it "
      "in its own format and layout, or in the format of the output's name. Values that no step "
      "changed keep their digits. Without --output and --output-dir, walk.bvh is written to "
      "walk.clean.bvh beside it, and standard input (-) to standard output.\n\n"
      "The report goes to standard output, or to standard error if standard output holds the "
      "take. Warnings and errors go to standard error. If one take cannot be read, the others are "
      "still cleaned; the exit code is the highest of all.";
  command.positionals = {{"IN", "take to clean; - is standard input", 0, 1000000, {}}};
  command.flags = clean_output_flags();
  append(command.flags, cleaning_flags());
  command.flags.push_back(contacts_flag());
  command.flags.push_back(switch_flag("all_takes", "Input",
                                      "clean every take of a file that holds several",
                                      "FBX and glTF; the format of the input is kept."));
  command.flags.push_back(jobs_flag());
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
      {"kinemend clean walk.bvh --feet auto", "also stop standing feet from sliding"},
      {"kinemend clean trial.c3d --fix-swaps --fill auto", "markers: labels, noise, then gaps"},
      {"kinemend clean hero.fbx --all-takes", "a character with several takes, in place"},
      {"kinemend clean - < in.bvh > out.bvh", "in a pipeline"},
      {"kinemend clean --preset biomech --print-config > lab.toml",
       "a settings file to keep and edit"}};
  command.run = run_clean;
  return command;
}

}  // namespace kinemend::cli
