#include "clean_flags.hpp"

#include <fmt/format.h>

#include <utility>

#include "config.hpp"
#include "kinemend/fill.hpp"
#include "method_options.hpp"
#include "page_report.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

Flag configurable(Flag flag) {
  flag.configurable = true;
  return flag;
}

Flag list_flag(std::string name, std::string help, std::string details) {
  Flag flag = text_flag(std::move(name), "A,B,...", "Where", std::move(help), std::move(details));
  flag.takes = Takes::list;
  return configurable(flag);
}

Flag markers_flag() {
  Flag flag = list_flag("markers", "the same as --joints", {});
  flag.configurable = false;
  return flag;
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

std::vector<std::string> fill_choices() {
  std::vector<std::string> names = {"off"};
  for (const FillMethod& method : fill_methods()) {
    if (!method.learned) names.emplace_back(method.name);
  }
  return names;
}

Flag noise_flag() {
  Flag flag = file_flag("noise", "white|auto|FILE", "Cleaning",
                        "what the noise is: found in the take (auto), white, or as in a report",
                        "FILE is a --report of clean or --json of check on a take of the same "
                        "system: its colour, and the strength of each joint or marker, are gone "
                        "by. For auto and the learned methods.");
  flag.spec.default_value = std::string("auto");
  flag.has_default = true;
  return flag;
}

Flag fill_flag() {
  Flag flag = text_flag("fill", "METHOD", "Cleaning", "fill gaps before anything is smoothed",
                        "auto picks a method for each gap, and refuses what it would only guess; "
                        "what is refused is listed, and stays missing in marker files.");
  flag.spec.default_value = std::string("off");
  flag.spec.choices = fill_choices();
  flag.has_default = true;
  return configurable(flag);
}

Flag feet_flag() {
  Flag flag = text_flag(
      "feet", "", "Cleaning", "stop feet that stand from sliding, after everything else",
      "auto holds what slides by error and leaves an intended slide alone; force holds whatever "
      "stands. Joints only; it moves legs and lowers the root, so that nothing does it unasked. "
      "Where "
      "names do not tell of feet, --map FILE does, with lines known name,name in the take.");
  flag.spec.default_value = std::string("off");
  flag.spec.choices = {"off", "auto", "force"};
  flag.has_default = true;
  return configurable(flag);
}

Flag root_position_flag() {
  Flag flag = switch_flag("root_position", "Where", "also clean the root's path");
  flag.spec.default_value = true;
  return configurable(flag);
}

// The letters of the flags that have one.
std::vector<Flag> with_letters(std::vector<Flag> list) {
  for (Flag& flag : list) {
    if (flag.spec.name == "verbose") flag.letter = 'v';
    if (flag.spec.name == "quiet") flag.letter = 'q';
    if (flag.spec.name == "method") flag.letter = 'm';
  }
  return list;
}

}  // namespace

std::vector<Flag> clean_output_flags() {
  return with_letters(
      {output_flag("where to write one take; - is standard output"),
       file_flag("output_dir", "DIR", "Output", "folder for the results, under the inputs' names",
                 "It is made where it does not exist. Several takes are cleaned in parallel.",
                 Completion::folder),
       force_flag(),
       switch_flag("dry_run", "Output", "clean and report, but write no take",
                   "A --report that is asked for is written."),
       reports_flag("also write what was done: FILE.json, or FILE.html as a page for a browser",
                    "JSON lists every span of samples that changed. The page shows one take: the "
                    "body before and after, curves, and everything that was found and done."),
       json_flag("print the summary as JSON instead of text"),
       switch_flag("verbose", "Output", "list every joint or marker that changed"),
       switch_flag("quiet", "Output", "print warnings and errors only")});
}

std::vector<Flag> cleaning_flags() {
  std::vector<Flag> list = with_letters(
      {method_flag(),
       configurable(number_flag("strength", "", 1, 0, 1, "Cleaning",
                                "how far to go from the input (0) to the cleaned motion (1)",
                                "Typical: 0.5 to 1. Spikes and gaps are repaired whole at any "
                                "strength above 0.")),
       configurable(number_flag("max_change_deg", "deg", 180, 0, 180, "Cleaning",
                                "no rotation goes further than this from its input",
                                "Typical: 5 to 30 against jitter alone; spikes need more.")),
       configurable(number_flag("max_change", "", 0, 0, 1e12, "Cleaning",
                                "no marker moves further than this, file units; 0: no limit",
                                "Typical: 5 to 20 mm against jitter alone; spikes need more.")),
       noise_flag(),
       fill_flag(),
       configurable(switch_flag("fill_all", "Cleaning",
                                "fill every gap, also where the rules of --fill refuse")),
       feet_flag(),
       configurable(switch_flag("fix_swaps", "Cleaning", "undo swapped labels of markers first",
                                "As kinemend check finds them; nothing happens to joints.")),
       configurable(number_flag("peak_loss_limit", "", 0.1, 0, 1, "Cleaning",
                                "share of a peak speed that may go without a warning",
                                "Typical: 0.05 for impacts to 0.2 for slow motion.")),
       preset_flag(),
       file_flag("config", "FILE", "Cleaning", "settings from a TOML file, over those of --preset"),
       switch_flag("print_config", "Cleaning",
                   "print the settings as a TOML file with comments, and stop"),
       list_flag("joints", "joints or markers that may change (default all)",
                 "Names or patterns in which * is any text and ? any character; quote them."),
       markers_flag(),
       list_flag("exclude", "what may not change after all", "Written like --joints."),
       root_position_flag(),
       text_flag(
           "range", "FIRST:LAST", "Where",
           "what may change: frames 121:240, as the file numbers them, or seconds 1s:2.5s",
           "Either end may be left out. The method sees all of the take; the result is blended "
           "in over 0.1 s."),
       file_flag("gaps", "FILE", "Input", "samples that count as missing: lines name,first,last",
                 "Frames as the file numbers them; for formats that cannot hold a gap. The name * "
                 "means all."),
       seed_flag("seed of the methods that draw random numbers")});
  append(list, reading_flags("what needs a repair or a warning becomes an error"));
  for (Flag& flag : list) {
    if (flag.spec.name == "strict") flag.configurable = true;
  }
  return list;
}

Flag contacts_flag() {
  return file_flag("contacts", "FILE", "Input",
                   "times in which feet stand, as kinemend contacts writes them; all are held",
                   "Of one take; sets --feet auto where that is off.");
}

Flag jobs_flag() {
  Flag flag = whole_flag("jobs", 0, 0, 1024, "Work", "threads; 0: as many as there are cores",
                         "The result does not depend on it.");
  flag.letter = 'j';
  return flag;
}

}  // namespace kinemend::cli
