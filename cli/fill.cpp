// kinemend fill: fills gaps from the rest of the take.

#include "kinemend/fill.hpp"

#include <fmt/format.h>

#include <vector>

#include "clean_flags.hpp"
#include "commands.hpp"
#include "fill_take.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"
#include "page_report.hpp"
#include "take_jobs.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

void fill_job(const TakeJob& job, const FillRun& run, const Arguments& arguments,
              Outcome& outcome) {
  refuse_folder(job.input, "fill", " --no-clean --fill auto");
  if (!run.dry_run) check_result(job, run.takes, run.force);
  const std::string name = input_name(job.input);
  const bool with_page = run.reports.with_page();
  FilledTake filled;
  run_isolated([&] { filled = fill_take(run, job, with_page); });
  outcome.warnings = filled.warnings;
  const std::size_t refused = filled.refused();
  const bool failed = run.strict && refused > 0;
  const std::string format = format_for(job.output, filled.after.source);
  if (!failed) {
    for (std::string& line : loss_lines(name, filled.after, format, run.strict))
      outcome.warnings.push_back(std::move(line));
  }
  if (!run.dry_run && !failed) {
    filled.report.take.output = job.output;
    write_result(job, run.takes, filled.after, format, run.force);
  }
  if (!run.plan_out_path.empty() && !failed)
    write_output(run.plan_out_path, filled.plan_text, run.force);
  TextOptions options;
  options.details = run.takes.jobs.size() == 1 || run.verbose;
  options.all = run.verbose;
  options.colours = Colours::of_out().on();
  outcome.text = to_text(filled.report, options);
  // With several takes, only the first line of each report is shown, as in `clean`.
  if (!options.details) outcome.text.resize(outcome.text.find('\n') + 1);
  if (run.json || run.reports.with_json()) outcome.json = outcome.report = to_json(filled.report);
  if (with_page)
    outcome.page =
        report_page(filled.report, filled.before, &filled.after, page_settings(arguments));
  if (!failed) return;
  outcome.code = static_cast<int>(ErrorKind::quality_limit);
  outcome.error = fmt::format("{}: {} refused, which --strict does not allow; nothing is written",
                              name, counted(refused, "gap"));
}

int run_fill(const Arguments& arguments) {
  const FillRun filling = fill_run_of(arguments);
  const TakeJobs& takes = filling.takes;
  const bool out_is_taken = (takes.jobs.front().output == "-" && !filling.dry_run) ||
                            filling.reports.on_out() || filling.plan_out_path == "-";
  const TakeRun run{"fill",       filling.reports, out_is_taken,   filling.quiet,
                    filling.json, filling.force,   filling.threads};
  return run_take_jobs(takes, run, [&](const TakeJob& job, const TakeProgress&) {
    return outcome_of(job.input, takes.jobs.size() > 1,
                      [&](Outcome& outcome) { fill_job(job, filling, arguments, outcome); });
  });
}

Flag fill_method_flag() {
  std::vector<std::string> names;
  for (const FillMethod& entry : fill_methods()) names.emplace_back(entry.name);
  Flag method = choice_flag("method", "Work", "how to fill", std::move(names), "auto",
                            "The methods are listed below.");
  method.letter = 'm';
  method.value_name = "NAME";
  return method;
}

std::vector<Flag> fill_flags() {
  std::vector<Flag> joints =
      joints_flags("Work", "joints or markers to fill (default all)", "names");
  constexpr double smallest_error = 1e-9, largest_error = 1e6;
  std::vector<Flag> flags = {
      output_flag(
          "where to write: a file for one take, or a folder (default walk.filled.bvh beside "
          "walk.bvh); - is standard output"),
      output_dir_flag(),
      force_flag(),
      switch_flag("dry_run", "Output", "report, but write no take", "A --report is still written."),
      reports_flag("also write what was done: FILE.json, or FILE.html as a page for a browser",
                   "The page shows the motion before and after."),
      json_flag("print what was done as JSON"),
      verbose_flag("list every gap"),
      quiet_flag(),
      fill_method_flag(),
      std::move(joints[0]),
      std::move(joints[1]),
      text_flag(
          "range", "FIRST:LAST", "Work",
          "fill gaps within frames 121:240, as the file numbers them, or seconds 1s:2.5s",
          "Either end may be omitted. A gap that is only partly inside stays open and is counted."),
      text_flag("donor", "MARKER", "Work", "marker whose movement --method pattern copies"),
      without_default(number_flag("longest_gap", "s", 0, 0, 100000, "Work",
                                  "longest gap to fill, instead of the method's own rule")),
      without_default(number_flag(
          "max_error_mm", "mm", 0, smallest_error, largest_error, "Work",
          "refuse fills of positions whose expected error is above this",
          "A fill whose error the method cannot tell is refused too. Cannot be combined with "
          "--fill-all.")),
      without_default(number_flag("max_error_deg", "deg", 0, smallest_error, 180, "Work",
                                  "the same for rotations of joints")),
      unlabelled_flag(),
      switch_flag("fill_all", "Work", "also fill gaps that the rules refuse",
                  "With the best guess available."),
      file_flag(
          "plan", "FILE", "Work", "fill the gaps of a gap plan, and no others",
          "One row for each gap, as --plan-out writes them. The verdict is fill, force (also if "
          "the rules refuse) or refuse. Gaps without a row stay open."),
      file_flag("plan_out", "FILE", "Work",
                "write the gap plan of this run, one row for each gap, to edit",
                "A CSV table, or FILE.json. With --dry-run no take is written."),
      switch_flag("preview", "Work", "add to the plan how far every other method would differ",
                  "The distance over the gap from the method of the row."),
      file_flag(
          "gaps", "FILE", "Input", "gaps that the format of the take cannot hold",
          "Lines NAME,FIRST,LAST: a joint or marker (* for all), and frames as the file numbers "
          "them, last included. The gap of a joint also covers its position channels, if any. "
          "Values inside a gap are ignored."),
      file_flag("model", "FILE", "Work",
                "network for --method recurrent, made by kinemend-train paper",
                "--network ebd --head pose trains one that fills gaps; none is included. Also "
                "used for rows of a --plan with that method, and for --preview. With --method "
                "learned: another network than the one that is included."),
      file_flag("map", "FILE", "Work", "names in the take for those of --model",
                "Lines NAME IN THE MODEL,NAME IN THE TAKE.")};
  flags.push_back(jobs_flag());
  append(flags, reading_flags("A refused gap counts, too."));
  return flags;
}

}  // namespace

Command fill_command() {
  Command command;
  command.name = "fill";
  command.summary = "fill the gaps of takes, each from the take itself";
  command.description =
      "Fills missing markers, and rotations and positions of joints, without a trained model "
      "(except --method recurrent and learned). A filled span joins its neighbours in value and "
      "velocity. "
      "Observed samples keep their bytes. The method auto tests the others on artificial gaps of "
      "the same length in the take and uses the best.\n\n"
      "Each method has rules for the gaps that it fills. A refused gap is listed with the reason "
      "and stays missing (BVH and AMC cannot hold gaps: they keep the values of the file), unless "
      "--fill-all is given. --max-error-mm and --max-error-deg also refuse fills whose expected "
      "error is too large. The report lists the longest filled gaps and the refused ones; "
      "--verbose lists all.\n\n"
      "Of several takes, those named *.filled.* are results of an earlier run and are skipped. If "
      "one take cannot be read, the others are still filled; the exit code is the highest of all.";
  command.positionals = {{"TAKE", "take to read; - is standard input", 1, 1000000, {}}};
  command.flags = fill_flags();
  for (const FillMethod& method : fill_methods()) {
    const std::string_view of = method.joints && method.markers ? "joints, markers"
                                : method.joints                 ? "joints"
                                                                : "markers";
    command.groups.push_back(
        {std::string(method.name),
         fmt::format("{} [{}]", method.summary, of),
         fmt::format("{}{}{}", method.rules, method.paper.empty() ? "" : "; from: ", method.paper),
         {}});
  }
  command.group_heading = "--method %";
  command.examples = {
      {"kinemend fill walk.c3d", "each gap by the best method, into walk.filled.c3d"},
      {"kinemend fill walk.c3d --dry-run --plan-out plan.csv",
       "a plan with one row for each gap, without filling"},
      {"kinemend fill *.c3d --output-dir filled", "many takes in parallel"},
      {"kinemend fill walk.c3d --plan plan.csv", "fill by the edited plan"},
      {"kinemend fill dance.bvh --gaps gaps.csv -o filled.bvh", "gaps listed in a side file"},
      {"kinemend fill walk.c3d -o filled.c3d --method pattern --donor RTHI --markers RKNE",
       "one marker, with the movement of its neighbour"}};
  command.run = run_fill;
  return command;
}

}  // namespace kinemend::cli
