// kinemend fill: fills gaps from the take itself.

#include "kinemend/fill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "commands.hpp"
#include "frame_range.hpp"
#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "page_report.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

std::size_t count_gaps(const Clip& clip) {
  return find_gaps(clip).size() + find_position_gaps(clip).size();
}
std::size_t count_gaps(const MarkerClip& clip) { return find_gaps(clip).size(); }

void mark_given_gaps(Take& take, const std::string& gap_file) {
  if (gap_file.empty()) return;
  const std::string name = input_name(gap_file);
  const std::vector<NamedGap> gaps = parse_gaps(read_file(gap_file), name, first_frame_of(take));
  try {
    std::visit([&](auto& clip) { mark_gaps(clip, gaps); }, take);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", name, error.what()));
  }
}

FillSettings settings_of(const Arguments& arguments) {
  FillSettings settings;
  settings.method = arguments.text("method");
  settings.names = arguments.list("names");
  settings.donor = arguments.text("donor");
  settings.longest_gap_s = arguments.given("longest_gap") ? arguments.number("longest_gap") : 0;
  settings.fill_all = arguments.flag("fill_all");
  return settings;
}

/// What `fill` was asked for, beside how to fill.
struct FillPlan {
  std::string input, output, gap_file, report_path;
  std::optional<FrameRange> range;
  bool json = false, force = false, dry_run = false, strict = false, quiet = false, verbose = false;
};

FillPlan plan_of(const Arguments& arguments) {
  FillPlan plan;
  plan.input = arguments.positionals[0];
  plan.output = arguments.text("output");
  if (plan.output.empty()) plan.output = output_beside(plan.input, "filled");
  plan.gap_file = arguments.text("gaps");
  plan.report_path = arguments.text("report");
  if (const std::string range = arguments.text("range"); !range.empty())
    plan.range = parse_range(range);
  plan.json = arguments.flag("json");
  plan.force = arguments.flag("force");
  plan.dry_run = arguments.flag("dry_run");
  plan.strict = arguments.flag("strict");
  plan.quiet = arguments.flag("quiet");
  plan.verbose = arguments.flag("verbose");
  check_page(plan.report_path, 1);
  check_single_use({plan.input, plan.gap_file},
                   {plan.dry_run ? std::string() : plan.output, plan.report_path}, plan.json);
  check_is_no_input("--report", plan.report_path, {plan.input, plan.gap_file, plan.output});
  check_is_no_input("--output", plan.output, {plan.gap_file});
  if (!plan.dry_run) check_free(plan.output, plan.force);
  if (!plan.report_path.empty()) check_free(plan.report_path, plan.force);
  return plan;
}

/// Fills the gaps of the take in place.
FillOutcome fill_take(Take& take, FillSettings settings, const FillPlan& plan) {
  return std::visit(
      [&](auto& clip) {
        if (plan.range)
          settings.range = frames_of(*plan.range, clip.frame_count(), clip.frame_rate_hz,
                                     first_frame_number(clip));
        FillOutcome outcome{fill_gaps(clip, settings)};
        if (plan.range) {
          // What is neither filled nor refused was not asked for.
          const std::size_t left = count_gaps(clip);
          outcome.not_within_range = left - std::min(left, outcome.report.refused());
        }
        return outcome;
      },
      take);
}

void say_outcome(const Report& report, const FillPlan& plan, const std::string& document) {
  if (plan.json) return write_out(document);
  if (plan.quiet) return;
  const bool out_is_taken = (plan.output == "-" && !plan.dry_run) || plan.report_path == "-";
  TextOptions options;
  options.all = plan.verbose;
  options.colours = Colours::of_out().on();
  const std::string text = to_text(report, options);
  out_is_taken ? write_err(text) : write_out(text);
}

int run(const Arguments& arguments) {
  const FillPlan plan = plan_of(arguments);
  const std::string name = input_name(plan.input);
  TakeResult read = read_take(std::filesystem::path(plan.input), read_options(arguments));
  warn_of_repairs(source_of(read.take), read.diagnostics);
  mark_given_gaps(read.take, plan.gap_file);
  std::optional<Take> before;
  if (is_page(plan.report_path)) before = read.take;
  FillOutcome filled = fill_take(read.take, settings_of(arguments), plan);
  for (const std::string& warning : filled.report.warnings)
    say_warning(fmt::format("{}: {}", name, warning));

  const std::size_t refused = filled.report.refused();
  const bool failed = plan.strict && refused > 0;
  const std::string format = format_for(plan.output, source_of(read.take));
  if (!failed) {
    for (const std::string& line : loss_lines(name, read.take, format, plan.strict))
      say_warning(line);
  }
  Report report{facts_of(read.take, plan.input, std::move(read.diagnostics)), std::move(filled)};
  if (!plan.dry_run && !failed) {
    report.take.output = plan.output;
    write_take_output(plan.output, read.take, format, plan.force);
  }
  const std::vector<std::string> takes = {to_json(report)};
  const std::string document = report_document("fill", takes);
  if (plan.report_path == "-" || (!plan.report_path.empty() && !failed))
    write_output(plan.report_path,
                 before ? page_of(report, *before, &read.take, page_settings(arguments)) : document,
                 plan.force);
  say_outcome(report, plan, document);
  if (!failed) return 0;
  say_error(fmt::format("{}: {} refused, which --strict does not allow; nothing is written", name,
                        counted(refused, "gap")));
  return static_cast<int>(ErrorKind::quality_limit);
}

Flag method_flag() {
  Flag method = text_flag("method", "NAME", "Work", "how to fill", "The methods are listed below.");
  method.letter = 'm';
  method.spec.default_value = std::string("auto");
  method.has_default = true;
  for (const FillMethod& entry : fill_methods()) method.spec.choices.emplace_back(entry.name);
  return method;
}

Flag gaps_flag() {
  Flag gaps = text_flag(
      "gaps", "FILE", "Input", "gaps that the take's own format cannot hold",
      "Lines NAME,FIRST,LAST: a joint or marker (* for all), and frames as the "
      "file numbers them, last included. A joint's gap is one of its position too, where it has "
      "position channels. What stands in a gap is not looked at.");
  gaps.completion = Completion::file;
  return gaps;
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
                             "longest gap to fill, in place of the method's own rule");
  longest.has_default = false;
  std::vector<Flag> flags = {
      output_flag("where to write (default walk.filled.bvh beside walk.bvh); - is standard output"),
      force_flag(),
      switch_flag("dry_run", "Output", "report, but write no take",
                  "A --report that is asked for is written."),
      report_flag("also write what was done, as JSON",
                  "FILE.html is a page for a browser, with the motion before and after."),
      json_flag("print what was done as JSON"),
      lettered('v', switch_flag("verbose", "Output", "list every gap")),
      lettered('q', switch_flag("quiet", "Output", "print warnings and errors only")),
      method_flag(),
      names,
      text_flag("range", "FIRST:LAST", "Work",
                "fill gaps within frames 121:240, as the file numbers them, or seconds 1s:2.5s",
                "Either end may be left out. A gap that reaches out of it stays, and is counted."),
      text_flag("donor", "MARKER", "Work", "marker whose movement --method pattern copies"),
      longest,
      switch_flag("fill_all", "Work", "also fill what the rules refuse",
                  "By the best guess there is."),
      gaps_flag()};
  append(flags, reading_flags("what needs a repair, and a gap that is refused, is an error"));
  return flags;
}

}  // namespace

Command fill_command() {
  Command command;
  command.name = "fill";
  command.summary = "fill the gaps of a take from the take itself";
  command.description =
      "Fills missing markers, and rotations and positions of joints, without a trained model. A "
      "filled span meets its ends in value and velocity; what was observed keeps its bytes. The "
      "method auto makes gaps of the same length in the take, tries the others on them, and takes "
      "what does best there.\n\n"
      "Each method has rules for what it accepts. A gap that they refuse is listed with the reason "
      "and stays missing (in BVH and AMC, which know no gaps: as the file had it), unless "
      "--fill-all is given. The report lists the longest gaps and apart from them what was "
      "refused, "
      "30 lines at most; --verbose lists all.";
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
      {"kinemend fill walk.c3d", "every gap by the method that suits it, into walk.filled.c3d"},
      {"kinemend fill dance.bvh --gaps gaps.csv -o filled.bvh", "gaps that a side file names"},
      {"kinemend fill walk.c3d -o filled.c3d --method pattern --donor RTHI --names RKNE",
       "one marker, after its neighbour"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
