// kinemend fill: fills gaps from the take itself.

#include "kinemend/fill.hpp"

#include <fmt/format.h>

#include <variant>

#include "commands.hpp"
#include "json.hpp"
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
  bool joints = false;
  std::string unit;      // of lengths; empty where it is not known
  std::string contents;  // of a file without markers
};

TakeFacts facts_of(const Clip& clip) {
  return {"", "", clip.skeleton.names, clip.frame_count(), clip.frame_rate_hz, true, "", ""};
}

TakeFacts facts_of(const MarkerClip& clip) {
  return {"", "", clip.names, clip.frame_count(), clip.frame_rate_hz, false, clip.unit, ""};
}

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

std::string gaps_table(const TakeFacts& take, const FillReport& report) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::left, Align::right,
               Align::left});
  table.add(
      {take.joints ? "joint" : "marker", "frames", "length", "s", "method", "expected error", ""});
  for (const GapOutcome& outcome : report.gaps) {
    const Gap& gap = outcome.gap;
    std::string name = printable(take.names[gap.track]);
    if (outcome.is_position) name += " (position)";
    table.add({std::move(name), fmt::format("{}-{}", gap.first_frame + 1, gap.last_frame + 1),
               grouped(gap.length()), fmt::format("{:.3f}", seconds_of(take, gap)), outcome.method,
               expected_text(take, outcome),
               outcome.filled ? "" : "refused: " + printable(outcome.reason)});
  }
  return table.text();
}

std::string report_text(const TakeFacts& take, const FillReport& report) {
  const std::string written = take.output.empty()  ? "; nothing written (dry run)"
                              : take.output == "-" ? ""
                                                   : "; written to " + printable(take.output);
  std::string text = Colours::of_out().paint(Paint::bold, printable(take.input)) + ": ";
  if (!take.contents.empty()) return text + take.contents + ": nothing to fill" + written + "\n";
  if (report.gaps.empty()) return text + "no gaps" + written + "\n";
  text += fmt::format("{}: {} filled, {} refused{}\n", counted(report.gaps.size(), "gap"),
                      report.filled(), report.refused(), written);
  text += fmt::format("  {}\n\n", length_text(take.frames, take.frame_rate_hz));
  return text + gaps_table(take, report);
}

Json report_json(const TakeFacts& take, const FillReport& report) {
  Json gaps = Json::array();
  for (const GapOutcome& outcome : report.gaps) {
    const std::string unit = unit_of(take, outcome);
    gaps.push_back(
        {{"name", take.names[outcome.gap.track]},
         {"kind", kind_of(take, outcome)},
         {"first_frame", outcome.gap.first_frame + 1},
         {"last_frame", outcome.gap.last_frame + 1},
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
          {"warnings", report.warnings},
          {"gaps", std::move(gaps)}};
}

void mark_given_gaps(Take& take, const std::string& gap_file) {
  if (gap_file.empty()) return;
  const std::vector<NamedGap> gaps = parse_gaps(read_file(gap_file), input_name(gap_file));
  try {
    std::visit([&](auto& clip) { mark_gaps(clip, gaps); }, take);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", input_name(gap_file), error.what()));
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

int run(const Arguments& arguments) {
  const std::string input = arguments.positionals[0];
  const std::string report_path = arguments.text("report"), gap_file = arguments.text("gaps");
  const bool json = arguments.flag("json"), force = arguments.flag("force");
  const bool dry_run = arguments.flag("dry_run");
  const std::string output = dry_run ? "" : arguments.text("output");
  if (output.empty() && !dry_run)
    throw Error(ErrorKind::usage, "fill: --output is missing (see kinemend fill -h)");
  check_single_use({input, gap_file}, {output, report_path}, json);
  check_is_no_input("--report", dry_run ? "" : report_path, {input, gap_file, output});
  check_is_no_input("--output", output, {gap_file});
  if (!dry_run) check_free(output, force);
  if (!report_path.empty() && !dry_run) check_free(report_path, force);

  TakeResult read = read_take(std::filesystem::path(input), read_options(arguments));
  warn_of_repairs(input_name(input), read.diagnostics);
  mark_given_gaps(read.take, gap_file);
  const FillSettings settings = settings_of(arguments);
  const FillReport report =
      std::visit([&](auto& clip) { return fill_gaps(clip, settings); }, read.take);
  TakeFacts take = std::visit([](const auto& clip) { return facts_of(clip); }, read.take);
  take.input = input_name(input);
  take.output = output;
  take.contents = pointless_text(read.take);
  for (const std::string& warning : report.warnings) say_warning(warning);

  const bool failed = arguments.flag("strict") && report.refused() > 0;
  if (failed) take.output.clear();
  const std::string format = format_for(output, source_of(read.take));
  if (!failed) {
    for (const std::string& line :
         loss_lines(take.input, read.take, format, arguments.flag("strict")))
      say_warning(line);
  }
  if (!dry_run && !failed) write_take_output(output, read.take, format, force);
  if (report_path == "-" || (!report_path.empty() && !dry_run && !failed)) {
    write_output(report_path, json_text(report_json(take, report)), force);
  }
  if (json) {
    write_out(json_text(report_json(take, report)));
  } else if (output == "-" || report_path == "-") {
    write_err(report_text(take, report));
  } else {
    write_out(report_text(take, report));
  }
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
  Flag gaps = text_flag("gaps", "FILE", "Input", "gaps that the take's own format cannot hold",
                        "Lines NAME,FIRST,LAST: a joint or marker (* for all), and frames from 1, "
                        "last included. A joint's gap is one of its position too, where it has "
                        "position channels. What stands in a gap is not looked at.");
  gaps.completion = Completion::file;
  return gaps;
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
      output_flag("where to write; - is standard output"),
      force_flag(),
      switch_flag("dry_run", "Output", "report and write nothing"),
      report,
      json_flag("print what was done as JSON"),
      method_flag(),
      names,
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
      "--fill-all is given.";
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
      {"kinemend fill walk.c3d -o filled.c3d", "every gap, each by the method that suits it"},
      {"kinemend fill dance.bvh --gaps gaps.csv -o filled.bvh", "gaps that a side file names"},
      {"kinemend fill walk.c3d -o filled.c3d --method pattern --donor RTHI --names RKNE",
       "one marker, after its neighbour"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
