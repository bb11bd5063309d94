// kinemend convert: reads one format and writes another, or the same format anew.

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "clean_flags.hpp"
#include "commands.hpp"
#include "fit_format.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/normalise.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "run_files.hpp"
#include "take_jobs.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// The inputs and the paths of their results.
struct Conversion {
  TakeJobs takes;
  const Format* to = nullptr;  ///< --to
  bool force = false;
};

using Notes = std::vector<std::string>;

/// `convert IN OUT`: two words name an input and an output, unless an option names the output. With
/// --to, an existing file with the extension of another format is an input, as in `convert *.c3d
/// --to trc`.
bool is_in_and_out(const Arguments& arguments) {
  const std::vector<std::string>& words = arguments.positionals;
  if (words.size() != 2 || arguments.given("output_dir") || arguments.given("output")) return false;
  if (!arguments.given("to")) return true;
  std::error_code ignored;
  const Format* const named = format_of_path(words[1]);
  return !fs::is_regular_file(words[1], ignored) || named == nullptr ||
         named->name == arguments.text("to");
}

void check_has_output(const Arguments& arguments) {
  if (arguments.given("output_dir") || arguments.given("output") || arguments.given("to")) return;
  const std::size_t inputs = arguments.positionals.size();
  throw Error(ErrorKind::usage,
              inputs == 1 ? "convert: OUT is missing (see kinemend convert -h)"
                          : fmt::format("convert: {} takes need --output-dir DIR, or --to FORMAT, "
                                        "which writes them beside the inputs",
                                        inputs));
}

Conversion conversion_of(const Arguments& arguments) {
  Conversion conversion;
  conversion.force = arguments.flag("force");
  if (const std::string to = arguments.text("to"); !to.empty()) conversion.to = &known_format(to);
  if (is_in_and_out(arguments)) {
    conversion.takes.jobs.push_back({arguments.positionals[0], arguments.positionals[1]});
    return conversion;
  }
  const std::vector<std::string>& words = arguments.positionals;
  std::error_code ignored;
  if (words.size() == 2 && arguments.given("output") && !fs::exists(words[1], ignored)) {
    throw Error(ErrorKind::usage, fmt::format("convert: {} and --output {} are two outputs; give "
                                              "one",
                                              words[1], arguments.text("output")));
  }
  check_has_output(arguments);
  conversion.takes = plan_take_jobs(arguments, words, {"", conversion.to});
  return conversion;
}

/// The format of --to, or of the output's extension, or of the input.
const Format& output_format(const Conversion& conversion, const std::string& output,
                            const Take& take) {
  if (conversion.to != nullptr) return *conversion.to;
  return known_format(format_for(output, take.source));
}

std::string_view axis_name(Axis axis) {
  return axis == Axis::x ? "x" : axis == Axis::y ? "y" : "z";
}

Take resampled(const Take& take, double frame_rate_hz, Notes& notes) {
  if (const std::string contents = pointless_text(take); !contents.empty())
    notes.push_back(fmt::format("{}: {}: --fps has no effect", take.source.name, contents));
  return resample(take, frame_rate_hz);
}

/// The old vertical axis is given by --from-up; otherwise it is guessed from the motion, with a
/// note.
Take turned(const Take& take, const Arguments& arguments, Notes& notes) {
  const Axis to = axis_named(arguments.text("up"));
  const std::string stated = arguments.text("from_up");
  const Axis from = stated.empty() ? guess_up_axis(take) : axis_named(stated);
  if (stated.empty()) {
    notes.push_back(fmt::format("{}: {} is taken to be the vertical axis (set it with --from-up)",
                                take.source.name, axis_name(from)));
  }
  return turn_axes(take, from, to);
}

void note_normalised(const Take& take, const Normalised& done, const Arguments& arguments,
                     Notes& notes) {
  const std::string& name = take.source.name;
  const std::string unit = take.has_joints() ? unit_name(take.metres_per_unit) : take.unit;
  const std::string_view shown = unit.empty() ? "units" : std::string_view(unit);
  if (arguments.flag("floor_at_zero")) {
    notes.push_back(fmt::format("{}: moved by {} {} along {}: the feet stand at 0", name,
                                figure(done.raised), shown, axis_name(done.up)));
  }
  if (arguments.flag("face_forward")) {
    notes.push_back(fmt::format(
        "{}: turned by {} deg about {}, then moved by {}, {}, {} {}: the first frame "
        "is at the origin and faces {}",
        name, figure(done.turned_deg), axis_name(done.up), figure(done.moved.x),
        figure(done.moved.y), figure(done.moved.z), shown, axis_name(forward_axis(done.up))));
  }
}

void normalise_take(Take& take, const Arguments& arguments, Notes& notes) {
  NormaliseSettings settings;
  settings.floor_at_zero = arguments.flag("floor_at_zero");
  settings.face_forward = arguments.flag("face_forward");
  if (!settings.floor_at_zero && !settings.face_forward) return;
  settings.names = names_of_map(arguments.text("map"));
  if (arguments.given("up")) settings.up = axis_named(arguments.text("up"));
  note_normalised(take, normalise(take, settings), arguments, notes);
}

/// Treats angles, forces, moments and powers as markers.
void take_all_points(Take& take) { take.is_position.clear(); }

/// AMC holds only angles; the skeleton goes to an ASF file beside it.
void check_has_place(const Take& take, const Format& format, const std::string& output) {
  if (format.name != "amc" || take.source.format == "amc" || output != "-") return;
  throw Error(ErrorKind::usage,
              "convert: AMC needs a skeleton file beside it; name an output file");
}

/// Applies the options to the take and brings it into a form that the format can hold.
Take converted(Take take, const Format& format, const Arguments& arguments, Notes& notes) {
  if (arguments.flag("plain")) drop_layout(take.source);
  if (arguments.flag("all_points")) take_all_points(take);
  if (arguments.given("fps")) take = resampled(take, arguments.number("fps"), notes);
  if (arguments.given("up")) take = turned(take, arguments, notes);
  if (arguments.given("unit")) {
    const double metres = metres_per_unit_of(take, notes);
    take = in_unit(take, arguments.text("unit"), metres);
  }
  normalise_take(take, arguments, notes);
  FitSettings settings;
  settings.positions = arguments.flag("positions");
  settings.end_sites = arguments.flag("end_sites");
  settings.keeps_unit = arguments.given("unit");
  return fitted(std::move(take), format, settings, notes);
}

void convert_job(const TakeJob& job, const Conversion& conversion, const Arguments& arguments,
                 Outcome& outcome) {
  refuse_folder(job.input, "convert", " --no-clean --to FORMAT");
  check_result(job, conversion.takes, conversion.force);
  TakeResult read = read_take(fs::path(job.input), read_options(arguments));
  for (const Diagnostic& entry : read.diagnostics.entries())
    outcome.warnings.push_back(diagnostic_line(read.take.source, entry));
  const Format& format = output_format(conversion, job.output, read.take);
  check_has_place(read.take, format, job.output);
  const Take take = converted(std::move(read.take), format, arguments, outcome.notes);
  for (std::string& line :
       loss_lines(input_name(job.input), take, format.name, arguments.flag("strict")))
    outcome.warnings.push_back(std::move(line));
  write_result(job, conversion.takes, take, std::string(format.name), conversion.force);
}

int run_convert(const Arguments& arguments) {
  const Conversion conversion = conversion_of(arguments);
  const TakeJobs& takes = conversion.takes;
  RunFiles files;
  files.reads("--asf", arguments.text("asf")).reads("--map", arguments.text("map"));
  const char* const option = is_in_and_out(arguments) ? "OUT" : result_option(takes);
  for (const TakeJob& job : takes.jobs)
    files.reads("IN", job.input).writes(option, job.output, job.input);
  files.check();
  if (conversion.to == nullptr && takes.folder.empty())
    check_take_ending(takes.jobs.front().output);
  const ReportFiles no_reports;
  TakeRun run{"convert", no_reports};
  run.quiet = arguments.flag("quiet");
  run.threads = static_cast<int>(arguments.whole("jobs"));
  return run_take_jobs(takes, run, [&](const TakeJob& job, const TakeProgress&) {
    return outcome_of(job.input, takes.jobs.size() > 1,
                      [&](Outcome& outcome) { convert_job(job, conversion, arguments, outcome); });
  });
}

std::vector<Flag> change_flags() {
  const std::vector<std::string> axes = {"x", "y", "z"};
  Flag fps = without_default(
      number_flag("fps", "Hz", 0, least_frame_rate_hz, most_frame_rate_hz, "Change",
                  "resample the motion to this rate",
                  "Samples are interpolated, not averaged: clean a noisy take first."));
  Flag up = choice_flag("up", "Change", "turn the axes so that this axis points up", axes);
  Flag from_up = choice_flag("from_up", "Change", "the axis that points up in the input", axes, "",
                             "Found from the motion if not given.");
  Flag unit = choice_flag("unit", "Change", "convert lengths to this unit", {"mm", "cm", "m"}, "",
                          "Without it, joint positions that become markers are in millimetres.");
  Flag floor =
      switch_flag("floor_at_zero", "Change", "move the take until its feet stand at height 0",
                  "By the lowest level on which a foot stands as a rule; of markers the "
                  "lowest marker of a foot. The distance is printed.");
  Flag forward = switch_flag(
      "face_forward", "Change",
      "turn and move the take so that it starts at the origin, facing forward",
      "Forward is z where y is up, and x where z is up. Angle and distance are printed.");
  return {std::move(fps),   std::move(up),      std::move(from_up), std::move(unit),
          std::move(floor), std::move(forward), map_flag()};
}

}  // namespace

Command convert_command() {
  Command command;
  command.name = "convert";
  command.summary = "write a take in another format, or rewrite it in its own";
  command.description = "Formats: ";
  for (const Format& format : formats()) {
    if (command.description.back() != ' ') command.description += ", ";
    command.description += fmt::format("{} ({})", format.name, format.description);
  }
  command.description +=
      ". The ending of OUT names the format; without an ending the format of the input is kept. "
      "Within one format, layout and digits of the source are kept, unless --plain is given. Rate, "
      "axes and units change only on request. Analog channels, force plates and events are kept "
      "where the format can hold them; a warning names each that is lost, which --strict makes an "
      "error.\n\n"
      "Several takes need --output-dir, or --to, which writes walk.trc beside walk.c3d. Takes that "
      "an earlier run wrote there are skipped. If one take cannot be read, the others are still "
      "converted; the exit code is the highest of all.\n\n"
      "In a format of markers (c3d, trc, tsv), joints become markers at their positions. The "
      "skeleton of an AMC file is written beside it, as an ASF file of the same name.";
  command.positionals = {{"IN", "take to read; - is standard input", 1, 1, {}},
                         {"OUT",
                          "file to write; - is standard output; or more takes, with --to or "
                          "--output-dir",
                          0,
                          1000000,
                          {}}};
  command.flags = {output_flag("where to write: a file for one take, or a folder"),
                   output_dir_flag(),
                   choice_flag("to", "Output", "format to write, whatever the ending of the output",
                               written_formats())};
  append(command.flags, change_flags());
  command.flags.push_back(switch_flag("positions", "Change",
                                      "write the positions of joints as markers",
                                      "For a format that can also hold the joints (csv)."));
  command.flags.push_back(switch_flag(
      "end_sites", "Change", "with the positions of joints, write those of end sites too"));
  command.flags.push_back(
      switch_flag("all_points", "Change",
                  "write the angles, forces, moments and powers of a C3D file as markers too",
                  "Without it they are left out of TRC, TSV and CSV, with a warning."));
  command.flags.push_back(
      switch_flag("plain", "Output", "write in the program's own layout, not that of the source",
                  "The content is kept: a C3D file keeps analog channels and parameters."));
  command.flags.push_back(force_flag());
  command.flags.push_back(quiet_flag());
  command.flags.push_back(jobs_flag());
  append(command.flags, reading_flags("What the format cannot hold counts, too."));
  command.examples = {
      {"kinemend convert odd.bvh plain.bvh --plain",
       "a file that other programs cannot read, in the plainest form"},
      {"kinemend convert 35_01.amc 35_01.bvh", "the skeleton is 35.asf in the same folder"},
      {"kinemend convert walk.c3d walk.trc --up y --unit m", "for OpenSim"},
      {"kinemend convert walk.bvh walk.glb", "for viewers and game engines"},
      {"kinemend convert *.c3d --to trc --output-dir trc", "many takes in parallel"},
      {"kinemend convert walk.bvh home.bvh --floor-at-zero --face-forward",
       "feet at height 0, start at the origin"}};
  command.run = run_convert;
  return command;
}

}  // namespace kinemend::cli
