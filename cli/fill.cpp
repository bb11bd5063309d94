// kinemend fill: fills gaps from the take itself.

#include "kinemend/fill.hpp"

#include <fmt/format.h>

#include <vector>

#include "commands.hpp"
#include "fill_take.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/report.hpp"
#include "page_report.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

void say_filling(const Report& report, const FillRun& run, const std::string& document) {
  if (run.json) return write_out(document);
  if (run.quiet) return;
  const bool out_is_taken =
      (run.output == "-" && !run.dry_run) || run.reports.on_out() || run.plan_out_path == "-";
  TextOptions options;
  options.all = run.verbose;
  options.colours = Colours::of_out().on();
  const std::string text = to_text(report, options);
  out_is_taken ? write_err(text) : write_out(text);
}

int run_fill(const Arguments& arguments) {
  const FillRun run = fill_run_of(arguments);
  const std::string name = input_name(run.input);
  const bool with_page = run.reports.with_page();
  FilledTake filled = fill_take(run, with_page);
  for (const std::string& warning : filled.warnings) say_warning(warning);

  const std::size_t refused = filled.refused();
  const bool failed = run.strict && refused > 0;
  const std::string format = format_for(run.output, filled.after.source);
  if (!failed) {
    for (const std::string& line : loss_lines(name, filled.after, format, run.strict))
      say_warning(line);
  }
  if (!run.dry_run && !failed) {
    filled.report.take.output = run.output;
    write_take_output(run.output, filled.after, format, run.force);
  }
  if (!run.plan_out_path.empty() && !failed)
    write_output(run.plan_out_path, filled.plan_text, run.force);
  const std::vector<std::string> takes = {to_json(filled.report)};
  const std::string document = report_document("fill", takes);
  if (run.reports.on_out() || !failed) {
    run.reports.write(document,
                      with_page ? report_page(filled.report, filled.before, &filled.after,
                                              page_settings(arguments))
                                : std::string(),
                      run.force);
  }
  say_filling(filled.report, run, document);
  if (!failed) return 0;
  say_error(fmt::format("{}: {} refused, which --strict does not allow; nothing is written", name,
                        counted(refused, "gap")));
  return static_cast<int>(ErrorKind::quality_limit);
}

Flag fill_method_flag() {
  Flag method = text_flag("method", "NAME", "Work", "how to fill", "The methods are listed below.");
  method.letter = 'm';
  method.spec.default_value = std::string("auto");
  method.has_default = true;
  for (const FillMethod& entry : fill_methods()) method.spec.choices.emplace_back(entry.name);
  return method;
}

Flag fill_gaps_flag() {
  Flag gaps = text_flag(
      "gaps", "FILE", "Input", "gaps that the format of the take cannot hold",
      "Lines NAME,FIRST,LAST: a joint or marker (* for all), and frames as the file numbers them, "
      "last included. The gap of a joint also covers its position channels, if any. Values inside "
      "a gap are ignored.");
  gaps.completion = Completion::file;
  return gaps;
}

Flag fill_file_flag(std::string name, std::string group, std::string help, std::string details) {
  Flag flag =
      text_flag(std::move(name), "FILE", std::move(group), std::move(help), std::move(details));
  flag.completion = Completion::file;
  return flag;
}

Flag lettered(char letter, Flag flag) {
  flag.letter = letter;
  return flag;
}

std::vector<Flag> fill_flags() {
  Flag names = text_flag("names", "NAME,...", "Work", "joints or markers to fill (default all)",
                         "Names and patterns (* any text, ? any character); quote them.");
  names.takes = Takes::list;
  Flag longest = number_flag("longest_gap", "s", 0, 0, 100000, "Work",
                             "longest gap to fill, instead of the method's own rule");
  longest.has_default = false;
  constexpr double smallest_error = 1e-9, largest_error = 1e6;
  Flag max_error_mm = number_flag(
      "max_error_mm", "mm", 0, smallest_error, largest_error, "Work",
      "refuse fills of positions whose expected error is above this",
      "A fill whose error the method cannot tell is refused too. Cannot be combined with "
      "--fill-all.");
  max_error_mm.has_default = false;
  Flag max_error_deg = number_flag("max_error_deg", "deg", 0, smallest_error, 180, "Work",
                                   "the same for rotations of joints");
  max_error_deg.has_default = false;
  std::vector<Flag> flags = {
      output_flag("where to write (default walk.filled.bvh beside walk.bvh); - is standard output"),
      force_flag(),
      switch_flag("dry_run", "Output", "report, but write no take", "A --report is still written."),
      reports_flag("also write what was done: FILE.json, or FILE.html as a page for a browser",
                   "The page shows the motion before and after."),
      json_flag("print what was done as JSON"),
      lettered('v', switch_flag("verbose", "Output", "list every gap")),
      lettered('q', switch_flag("quiet", "Output", "print warnings and errors only")),
      fill_method_flag(),
      names,
      text_flag(
          "range", "FIRST:LAST", "Work",
          "fill gaps within frames 121:240, as the file numbers them, or seconds 1s:2.5s",
          "Either end may be omitted. A gap that is only partly inside stays open and is counted."),
      text_flag("donor", "MARKER", "Work", "marker whose movement --method pattern copies"),
      longest,
      max_error_mm,
      max_error_deg,
      unlabelled_flag(),
      switch_flag("fill_all", "Work", "also fill gaps that the rules refuse",
                  "With the best guess available."),
      fill_file_flag(
          "plan", "Work", "fill the gaps of a gap plan, and no others",
          "One row for each gap, as --plan-out writes them. The verdict is fill, force (also if "
          "the rules refuse) or refuse. Gaps without a row stay open."),
      fill_file_flag("plan_out", "Work",
                     "write the gap plan of this run, one row for each gap, to edit",
                     "A CSV table, or FILE.json. With --dry-run no take is written."),
      switch_flag("preview", "Work", "add to the plan how far every other method would differ",
                  "The distance over the gap from the method of the row."),
      fill_gaps_flag(),
      fill_file_flag("model", "Work",
                     "network for --method recurrent, made by kinemend-train paper",
                     "--network ebd --head pose trains one that fills gaps; none is included. Also "
                     "used for rows of a --plan with that method, and for --preview. With --method "
                     "learned: another network than the one that is included."),
      fill_file_flag("map", "Work", "names in the take for those of --model",
                     "Lines NAME IN THE MODEL,NAME IN THE TAKE.")};
  append(flags, reading_flags("a repair or a refused gap becomes an error"));
  return flags;
}

}  // namespace

Command fill_command() {
  Command command;
  command.name = "fill";
  command.summary = "fill the gaps of a take from the take itself";
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
      "--verbose lists all.";
  command.positionals = {{"TAKE", "take to read; - is standard input", 1, 1, {}}};
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
      {"kinemend fill walk.c3d --plan plan.csv", "fill by the edited plan"},
      {"kinemend fill dance.bvh --gaps gaps.csv -o filled.bvh", "gaps listed in a side file"},
      {"kinemend fill walk.c3d -o filled.c3d --method pattern --donor RTHI --names RKNE",
       "one marker, with the movement of its neighbour"}};
  command.run = run_fill;
  return command;
}

}  // namespace kinemend::cli
