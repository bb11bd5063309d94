// kinemend clean: reads takes, cleans them, writes them, and prints reports.

#include <fmt/format.h>

#include <string>

#include "clean_file.hpp"
#include "clean_flags.hpp"
#include "clean_plan.hpp"
#include "commands.hpp"
#include "method_options.hpp"
#include "take_jobs.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

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
  const bool out_is_taken =
      plan.reports.on_out() || (!plan.dry_run && plan.takes.jobs.front().output == "-");
  const TakeRun run{"clean",   plan.reports, out_is_taken, plan.quiet,
                    plan.json, plan.force,   plan.threads};
  return run_take_jobs(plan.takes, run, [&](const TakeJob& job, const TakeProgress& progress) {
    return clean_file(job, plan, progress);
  });
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
      "walk.clean.bvh beside it, and standard input (-) to standard output. Of several takes, "
      "those named *.clean.* are results of an earlier run and are skipped.\n\n"
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
      {"kinemend clean *.bvh --output-dir clean", "many takes in parallel"},
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
