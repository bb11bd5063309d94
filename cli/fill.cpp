// kinemend fill: fills gaps from the take itself.

#include "kinemend/fill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <variant>

#include "commands.hpp"
#include "frame_range.hpp"
#include "json.hpp"
#include "kinemend/frame_numbers.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/io.hpp"
#include "kinemend/version.hpp"
#include "table.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

/// What the report needs to know of the take.
struct TakeFacts {
  std::string input, output;  // output empty: nothing is written
  std::vector<std::string> names;
  std::size_t frames = 0;
  double frame_rate_hz = 0;
  std::int64_t first_frame = 1;  // its number
  bool joints = false;
  std::string unit;        // of lengths; empty where it is not known
  std::string contents;    // of a file without markers
  std::size_t beyond = 0;  // gaps that do not lie within --range
};

TakeFacts facts_of(const Clip& clip) {
  TakeFacts take;
  take.names = clip.skeleton.names;
  take.joints = true;
  return take;
}

TakeFacts facts_of(const MarkerClip& clip) {
  TakeFacts take;
  take.names = clip.names;
  take.unit = clip.unit;
  return take;
}

std::size_t count_gaps(const Clip& clip) {
  return find_gaps(clip).size() + find_position_gaps(clip).size();
}
std::size_t count_gaps(const MarkerClip& clip) { return find_gaps(clip).size(); }

std::string_view kind_of(const TakeFacts& take, const GapOutcome& gap) {
  if (!take.joints) return "marker";
  return gap.is_position ? "position" : "rotation";
}

std::string unit_of(const TakeFacts& take, const GapOutcome& gap) {
  return take.joints && !gap.is_position ? "deg" : take.unit;
}

double seconds_of(const TakeFacts& take, const Gap& gap) {
  return static_cast<double>(gap.length()) / take.frame_rate_hz;
}

std::string expected_text(const TakeFacts& take, const GapOutcome& gap) {
  if (!(gap.expected_error > 0)) return "";
  const std::string unit = unit_of(take, gap);
  return figure(gap.expected_error) + (unit.empty() ? "" : " " + unit);
}

constexpr std::size_t most_filled = 10, most_refused = 8;

std::vector<std::string> gap_cells(const TakeFacts& take, const GapOutcome& outcome) {
  const Gap& gap = outcome.gap;
  std::string name = printable(take.names[gap.track]);
  if (outcome.is_position) name += " (position)";
  return {std::move(name),
          fmt::format("{}-{}", frame_number(gap.first_frame, take.first_frame),
                      frame_number(gap.last_frame, take.first_frame)),
          grouped(gap.length()), fmt::format("{:.3f}", seconds_of(take, gap))};
}

/// "3 by pca, 1 by pchip".
std::string methods_text(const FillReport& report) {
  std::map<std::string, std::size_t> counts;
  for (const GapOutcome& outcome : report.gaps) counts[outcome.method] += outcome.filled ? 1 : 0;
  std::vector<std::string> parts;
  for (const auto& [method, count] : counts) {
    if (count > 0) parts.push_back(fmt::format("{} by {}", grouped(count), method));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// The longest of those that were filled, or all, in the order of the report.
std::string filled_table(const TakeFacts& take, const FillReport& report, bool all) {
  std::vector<const GapOutcome*> filled;
  for (const GapOutcome& outcome : report.gaps) {
    if (outcome.filled) filled.push_back(&outcome);
  }
  if (filled.empty()) return "";
  const std::size_t count = filled.size();
  if (!all && count > most_filled) {
    std::stable_sort(filled.begin(), filled.end(), [](const auto* a, const auto* b) {
      return a->gap.length() > b->gap.length();
    });
    filled.resize(most_filled);
    std::sort(filled.begin(), filled.end());
  }
  Table table({Align::left, Align::right, Align::right, Align::right, Align::left, Align::right});
  table.add(
      {take.joints ? "joint" : "marker", "frames", "length", "s", "method", "expected error"});
  for (const GapOutcome* outcome : filled) {
    std::vector<std::string> cells = gap_cells(take, *outcome);
    cells.insert(cells.end(), {outcome->method, expected_text(take, *outcome)});
    table.add(std::move(cells));
  }
  std::string text = "\n" + table.text();
  if (filled.size() < count) {
    text += fmt::format("  and {} shorter ones (--verbose lists them)\n",
                        grouped(count - filled.size()));
  }
  return text;
}

std::string refused_table(const TakeFacts& take, const FillReport& report, bool all) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::left}, 4);
  std::size_t count = 0;
  for (const GapOutcome& outcome : report.gaps) {
    if (outcome.filled || (++count > most_refused && !all)) continue;
    std::vector<std::string> cells = gap_cells(take, outcome);
    cells.push_back(printable(outcome.reason));
    table.add(std::move(cells));
  }
  if (count == 0) return "";
  std::string text = fmt::format("\n  {} refused:\n", grouped(count)) + table.text();
  if (count > most_refused && !all)
    text += fmt::format("    and {} more (--verbose lists them)\n", grouped(count - most_refused));
  return text;
}

std::string report_text(const TakeFacts& take, const FillReport& report, bool all) {
  const std::string written = take.output.empty()  ? "; nothing written (dry run)"
                              : take.output == "-" ? ""
                                                   : "; written to " + printable(take.output);
  const std::string beyond = take.beyond == 0 ? ""
                                              : fmt::format("; {} not within --range left alone",
                                                            counted(take.beyond, "gap"));
  std::string text = Colours::of_out().paint(Paint::bold, printable(take.input)) + ": ";
  if (!take.contents.empty()) return text + take.contents + ": nothing to fill" + written + "\n";
  if (report.gaps.empty()) return text + "no gaps" + beyond + written + "\n";
  text += fmt::format("{}: {} filled, {} refused{}{}\n", counted(report.gaps.size(), "gap"),
                      report.filled(), report.refused(), beyond, written);
  text += fmt::format("  {}", length_text(take.frames, take.frame_rate_hz));
  if (report.filled() > 0) text += "; " + methods_text(report);
  return text + "\n" + filled_table(take, report, all) + refused_table(take, report, all);
}

Json report_json(const TakeFacts& take, const FillReport& report) {
  Json gaps = Json::array();
  for (const GapOutcome& outcome : report.gaps) {
    const std::string unit = unit_of(take, outcome);
    gaps.push_back(
        {{"name", take.names[outcome.gap.track]},
         {"kind", kind_of(take, outcome)},
         {"first_frame", frame_number(outcome.gap.first_frame, take.first_frame)},
         {"last_frame", frame_number(outcome.gap.last_frame, take.first_frame)},
         {"frames", outcome.gap.length()},
         {"duration_s", seconds_of(take, outcome.gap)},
         {"filled", outcome.filled},
         {"method", outcome.method},
         {"expected_error", outcome.expected_error > 0 ? Json(outcome.expected_error) : Json()},
         {"unit", unit.empty() ? Json() : Json(unit)},
         {"reason", outcome.filled ? Json() : Json(outcome.reason)}});
  }
  return {{"kinemend", version()},
          {"input", take.input},
          {"output", take.output.empty() ? Json() : Json(take.output)},
          {"frames", take.frames},
          {"frame_rate_hz", take.frame_rate_hz},
          {"filled", report.filled()},
          {"refused", report.refused()},
          {"not_within_range", take.beyond},
          {"warnings", report.warnings},
          {"gaps", std::move(gaps)}};
}

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
  check_single_use({plan.input, plan.gap_file},
                   {plan.dry_run ? std::string() : plan.output, plan.report_path}, plan.json);
  check_is_no_input("--report", plan.report_path, {plan.input, plan.gap_file, plan.output});
  check_is_no_input("--output", plan.output, {plan.gap_file});
  if (!plan.dry_run) check_free(plan.output, plan.force);
  if (!plan.report_path.empty()) check_free(plan.report_path, plan.force);
  return plan;
}

/// The take with its gaps filled, and what became of them.
FillReport fill_take(Take& take, FillSettings settings, const FillPlan& plan, TakeFacts& facts) {
  mark_given_gaps(take, plan.gap_file);
  return std::visit(
      [&](auto& clip) {
        facts = facts_of(clip);
        facts.input = input_name(plan.input);
        facts.frames = clip.frame_count();
        facts.frame_rate_hz = clip.frame_rate_hz;
        facts.first_frame = first_frame_number(clip);
        if (!plan.range) return fill_gaps(clip, settings);
        settings.range =
            frames_of(*plan.range, clip.frame_count(), clip.frame_rate_hz, facts.first_frame);
        FillReport report = fill_gaps(clip, settings);
        const std::size_t left = count_gaps(clip);
        // What is neither filled nor refused was not asked for.
        facts.beyond = left - std::min(left, report.refused());
        return report;
      },
      take);
}

void say_outcome(const TakeFacts& take, const FillReport& report, const FillPlan& plan) {
  if (plan.json) return write_out(json_text(report_json(take, report)));
  if (plan.quiet) return;
  const bool out_is_taken = (plan.output == "-" && !plan.dry_run) || plan.report_path == "-";
  const std::string text = report_text(take, report, plan.verbose);
  out_is_taken ? write_err(text) : write_out(text);
}

int run(const Arguments& arguments) {
  const FillPlan plan = plan_of(arguments);
  TakeResult read = read_take(std::filesystem::path(plan.input), read_options(arguments));
  warn_of_repairs(source_of(read.take), read.diagnostics);
  TakeFacts take;
  const FillReport report = fill_take(read.take, settings_of(arguments), plan, take);
  take.contents = pointless_text(read.take);
  for (const std::string& warning : report.warnings)
    say_warning(fmt::format("{}: {}", take.input, warning));

  const bool failed = plan.strict && report.refused() > 0;
  const bool is_written = !plan.dry_run && !failed;
  const std::string format = format_for(plan.output, source_of(read.take));
  if (!failed) {
    for (const std::string& line : loss_lines(take.input, read.take, format, plan.strict))
      say_warning(line);
  }
  if (is_written) {
    take.output = plan.output;
    write_take_output(plan.output, read.take, format, plan.force);
  }
  if (plan.report_path == "-" || (!plan.report_path.empty() && !failed))
    write_output(plan.report_path, json_text(report_json(take, report)), plan.force);
  say_outcome(take, report, plan);
  if (!failed) return 0;
  say_error(fmt::format("{}: {} refused, which --strict does not allow; nothing is written",
                        take.input, counted(report.refused(), "gap")));
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
  Flag report = text_flag("report", "FILE", "Output", "also write what was done, as JSON");
  report.completion = Completion::file;
  std::vector<Flag> flags = {
      output_flag("where to write (default walk.filled.bvh beside walk.bvh); - is standard output"),
      force_flag(),
      switch_flag("dry_run", "Output", "report, but write no take",
                  "A --report that is asked for is written."),
      report,
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
