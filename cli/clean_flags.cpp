// Defines each flag of cleaning: its choices, its help, its letter, and whether a configuration
// file may hold it.
#include "clean_flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "config.hpp"
#include "kinemend/clean.hpp"
#include "method_options.hpp"
#include "page_report.hpp"
#include "take_jobs.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

Flag configurable(Flag flag) {
  flag.configurable = true;
  return flag;
}

Flag exclude_flag() {
  Flag flag =
      text_flag("exclude", "A,B,...", "Where", "exceptions to --joints", "Written like --joints.");
  flag.takes = Takes::list;
  return configurable(flag);
}

// A setting of the library's table.
Flag setting_flag(std::string_view name, std::string group, std::string details = {}) {
  Flag flag;
  flag.spec = clean_option(name);
  if (std::holds_alternative<bool>(flag.spec.default_value)) flag.takes = Takes::nothing;
  flag.group = std::move(group);
  flag.details = std::move(details);
  return configurable(flag);
}

Flag method_flag() {
  Flag flag =
      text_flag("method", "NAME", "Cleaning", "how to clean; kinemend methods lists all",
                "The options of a method are valid with that method only; kinemend help NAME lists "
                "them.");
  flag.letter = 'm';
  flag.spec.default_value = std::string(default_method);
  flag.spec.choices = method_names();
  flag.has_default = true;
  return configurable(flag);
}

Flag preset_flag() {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  return choice_flag(
      "preset", "Cleaning", "settings of a live stream or of a gait laboratory", std::move(names),
      "", "kinemend help presets describes them. --config and the command line override them.");
}

Flag noise_flag() {
  Flag flag = file_flag("noise", "white|auto|FILE", "Cleaning",
                        "what the noise is: measured in the take (auto), white, or as in a report",
                        "FILE is a --report of clean or check as JSON, of another take of the same "
                        "capture system. For auto and the learned methods.");
  flag.spec.default_value = std::string("auto");
  flag.has_default = true;
  return flag;
}

Flag fill_flag() {
  Flag flag = setting_flag(
      "fill", "Cleaning",
      "auto tests the methods on artificial gaps, picks one for each gap, and leaves a gap open "
      "when none is reliable. kinemend fill -h lists the methods.");
  flag.value_name = "METHOD";
  return flag;
}

}  // namespace

std::vector<Flag> clean_output_flags() {
  return {
      output_flag("where to write: a file for one take, or a folder; - is standard output"),
      output_dir_flag(),
      force_flag(),
      switch_flag("dry_run", "Output", "clean and report, but write no take",
                  "A --report is still written."),
      reports_flag("also write what was done: FILE.json, or FILE.html as a page for a browser",
                   "JSON lists every span of samples that changed. A page shows one take, before "
                   "and after."),
      json_flag("print the summary as JSON instead of text"),
      verbose_flag("list every joint or marker that changed"),
      quiet_flag()};
}

std::vector<Flag> cleaning_flags() {
  std::vector<Flag> list = {
      method_flag(),
      setting_flag("strength", "Cleaning",
                   "Typical: 0.5 to 1. Any strength above 0 repairs spikes and gaps in full."),
      setting_flag("max_change_deg", "Cleaning",
                   "Typical: 5 to 30 against jitter alone; spikes need more."),
      setting_flag("max_change", "Cleaning",
                   "Typical: 5 to 20 mm against jitter alone; spikes need more."),
      configurable(source_flag()),
      noise_flag(),
      fill_flag(),
      setting_flag("fill_all", "Cleaning"),
      setting_flag("feet", "Cleaning",
                   "auto keeps intentional slides; force holds every foot that stands. By default "
                   "feet are held if --source, or the file, says video, depth or suit. For joints; "
                   "it moves the legs and the root. --map FILE gives unknown names of feet, "
                   "in lines KNOWN NAME,NAME IN THE TAKE."),
      setting_flag("fix_swaps", "Cleaning", "kinemend check lists them. For markers."),
      setting_flag("peak_loss_limit", "Cleaning",
                   "Typical: 0.05 for impacts to 0.2 for slow motion."),
      setting_flag("unlabelled", "Cleaning", unlabelled_flag().details),
      preset_flag(),
      file_flag("config", "FILE", "Cleaning", "settings from a TOML file; they override --preset"),
      switch_flag("print_config", "Cleaning",
                  "print the settings as a commented TOML file, then exit"),
      exclude_flag(),
      setting_flag("root_position", "Where"),
      text_flag("range", "FIRST:LAST", "Where",
                "what may change: frames 121:240, as the file numbers them, or seconds 1s:2.5s",
                "Either end may be omitted. The method still sees the whole take."),
      file_flag("gaps", "FILE", "Input", "samples to treat as missing: lines name,first,last",
                "For formats that cannot hold a gap; see kinemend help gaps."),
      seed_flag("seed of the methods that draw random numbers")};
  std::vector<Flag> joints =
      joints_flags("Where", "joints or markers that may change (default all)");
  joints.front().configurable = true;
  const auto exclude = std::find_if(list.begin(), list.end(),
                                    [](const Flag& flag) { return flag.spec.name == "exclude"; });
  list.insert(exclude, joints.begin(), joints.end());
  append(list, reading_flags());
  for (Flag& flag : list) {
    if (flag.spec.name == "strict") flag.configurable = true;
  }
  return list;
}

Flag contacts_flag() {
  return file_flag("contacts", "FILE", "Input",
                   "ground contacts to hold, as kinemend contacts writes them",
                   "For one take. Implies --feet auto.");
}

Flag jobs_flag() {
  Flag flag = whole_flag("jobs", 0, 0, 1024, "Work", "threads; 0: one per core",
                         "The result does not depend on it.");
  flag.letter = 'j';
  return flag;
}

}  // namespace kinemend::cli
