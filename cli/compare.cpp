// kinemend compare: every error figure of two takes, and limits on them.

#include <fmt/format.h>

#include <limits>
#include <vector>

#include "commands.hpp"
#include "kinemend/io.hpp"
#include "kinemend/metrics.hpp"
#include "kinemend/report.hpp"
#include "page_report.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

ComparisonSettings comparison_settings(const Arguments& arguments, const Clip& reference) {
  ComparisonSettings settings;
  settings.first_frame = leading_calibration_frames(reference);
  if (arguments.given("psnr_peak")) settings.psnr_peak = arguments.number("psnr_peak");
  if (arguments.given("metres_per_unit"))
    settings.metres_per_unit = arguments.number("metres_per_unit");
  const std::string up = arguments.text("up");
  settings.foot_slide.up = up == "x" ? Axis::x : up == "z" ? Axis::z : Axis::y;
  return settings;
}

TakeFacts take_of(const ReadResult& read, const std::string& name) {
  TakeFacts facts = take_facts(read.clip);
  facts.input = name;
  facts.diagnostics = read.diagnostics;
  return facts;
}

std::string comparison_page(const Report& report, const Clip& reference, const Clip& other,
                            const Arguments& arguments) {
  PageSettings settings = page_settings(arguments);
  settings.before_label = "reference";
  settings.after_label = "other";
  return report_page(report, reference, &other, settings);
}

int run(const Arguments& arguments) {
  const std::string reference_name = arguments.positionals[0];
  const std::string other_name = arguments.positionals[1];
  const std::string report_path = arguments.text("report");
  const bool json = arguments.flag("json"), force = arguments.flag("force");
  check_page(report_path, 1);
  check_single_use({reference_name, other_name}, {report_path}, json);
  check_is_no_input("--report", report_path, {reference_name, other_name});
  if (!report_path.empty()) check_free(report_path, force);
  const ReadResult reference =
      read_clip(std::filesystem::path(reference_name), read_options(arguments));
  const ReadResult other = read_clip(std::filesystem::path(other_name), read_options(arguments));
  warn_of_repairs(reference.clip.source, reference.diagnostics);
  warn_of_repairs(other.clip.source, other.diagnostics);
  Report report{take_of(other, other_name),
                CompareOutcome{reference_name,
                               compare_clips(reference.clip, other.clip,
                                             comparison_settings(arguments, reference.clip))}};
  // Joints are the same, and the reference says how they are spelled.
  report.take.tracks = reference.clip.skeleton.names;
  const std::vector<std::string> takes = {to_json(report)};
  const std::string document = report_document("compare", takes);
  if (!report_path.empty()) {
    write_output(report_path,
                 is_page(report_path)
                     ? comparison_page(report, reference.clip, other.clip, arguments)
                     : document,
                 force);
  }
  if (json) {
    write_out(document);
  } else if (report_path != "-") {
    TextOptions options;
    options.all = arguments.flag("per_joint");
    write_out(to_text(report, options));
  }
  return say_passed_limits(report, comparison_figures(), arguments);
}

Flag number_without_default(std::string name, std::string unit, double minimum, double maximum,
                            std::string group, std::string help) {
  Flag flag = number_flag(std::move(name), std::move(unit), 0, minimum, maximum, std::move(group),
                          std::move(help));
  flag.has_default = false;
  return flag;
}

std::vector<Flag> flags() {
  Flag up = text_flag("up", "", "Figures", "vertical axis, for foot_slide (default y)");
  up.spec.choices = {"x", "y", "z"};
  std::vector<Flag> list = {
      json_flag("print JSON instead of text"),
      switch_flag("per_joint", "Output", "also list every joint"),
      report_flag("also write the figures, as JSON",
                  "FILE.html is a page for a browser, with both takes."),
      force_flag(),
      number_without_default("metres_per_unit", "m", 1e-9, 1e6, "Figures",
                             "length of a file unit; found from the skeleton's height otherwise"),
      number_without_default("psnr_peak", "rad", 1e-9, 1e6, "Figures",
                             "peak of psnr_db (default pi / 2)"),
      up};
  append(list, reading_flags("what needs a repair becomes an error"));
  for (const FigureRule& entry : comparison_figures()) {
    Flag limit =
        number_without_default(std::string(entry.limit), std::string(entry.unit),
                               entry.more_is_better ? -1e9 : 0, 1e12, "Limits",
                               fmt::format("exit code 1 where {} is {}", entry.name,
                                           entry.more_is_better ? "below this" : "above this"));
    // The range says nothing that the unit does not.
    limit.spec.maximum = std::numeric_limits<double>::infinity();
    limit.spec.minimum = -std::numeric_limits<double>::infinity();
    list.push_back(limit);
  }
  return list;
}

}  // namespace

Command compare_command() {
  Command command;
  command.name = "compare";
  command.summary = "print every error figure of a take against its reference";
  command.description =
      "Both takes have the same joints and frames. A calibration pose at the start of the "
      "reference "
      "is left out. Each --max and --min option sets a limit; where a figure passes one, the exit "
      "code is 1.";
  command.positionals = {{"REFERENCE", "the truth; - is standard input", 1, 1, {}},
                         {"OTHER", "the take to judge", 1, 1, {}}};
  command.flags = flags();
  command.examples = {{"kinemend compare truth.bvh cleaned.bvh", "all figures"},
                      {"kinemend compare truth.bvh cleaned.bvh --max-geodesic-rms-deg 1.2",
                       "as a check in a script"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
