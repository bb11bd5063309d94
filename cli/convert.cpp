// kinemend convert: reads one format and writes another, or the same anew.

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "kinemend/experimental/normalise.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/io.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

const Format& format_named(std::string_view name) {
  for (const Format& format : formats()) {
    if (format.name == name) return format;
  }
  throw Error(ErrorKind::usage, fmt::format("unknown format {}", name));
}

/// OUT, or --output.
std::string converted_output_of(const Arguments& arguments) {
  std::string named = arguments.text("output");
  if (arguments.positionals.size() == 1) {
    if (!named.empty()) return named;
    throw Error(ErrorKind::usage, "convert: OUT is missing (see kinemend convert -h)");
  }
  if (named.empty()) return arguments.positionals[1];
  throw Error(ErrorKind::usage, fmt::format("convert: {} and --output {} are two outputs; give one",
                                            arguments.positionals[1], named));
}

/// --to, else by the ending of the output, else the format of the input.
const Format& output_format(const Arguments& arguments, const std::string& output,
                            const Take& take) {
  if (const std::string format = arguments.text("to"); !format.empty()) return format_named(format);
  return format_named(format_for(output, take.source));
}

Axis axis_named(const std::string& name) {
  return name == "x" ? Axis::x : name == "y" ? Axis::y : Axis::z;
}

std::string_view axis_name(Axis axis) {
  return axis == Axis::x ? "x" : axis == Axis::y ? "y" : "z";
}

Take resampled(const Take& take, double frame_rate_hz) {
  if (const std::string contents = pointless_text(take); !contents.empty())
    say(fmt::format("{}: {}: --fps has no effect", take.source.name, contents));
  return resample(take, frame_rate_hz);
}

/// The old vertical axis is that of --from-up, else it is found from the motion and said.
Take turned(const Take& take, const Arguments& arguments) {
  const Axis to = axis_named(arguments.text("up"));
  const std::string stated = arguments.text("from_up");
  const Axis from = stated.empty() ? guess_up_axis(take) : axis_named(stated);
  if (stated.empty()) {
    say(fmt::format("{}: {} is taken to be the vertical axis (set it with --from-up)",
                    take.source.name, axis_name(from)));
  }
  return turn_axes(take, from, to);
}

void say_normalised(const Take& take, const Normalised& done, const Arguments& arguments) {
  const std::string& name = take.source.name;
  const std::string unit = take.has_joints() ? unit_name(take.metres_per_unit) : take.unit;
  const std::string_view shown = unit.empty() ? "units" : std::string_view(unit);
  if (arguments.flag("floor_at_zero")) {
    say(fmt::format("{}: moved by {} {} along {}: the feet stand at 0", name, figure(done.raised),
                    shown, axis_name(done.up)));
  }
  if (arguments.flag("face_forward")) {
    say(fmt::format(
        "{}: turned by {} deg about {}, then moved by {}, {}, {} {}: the first frame "
        "is at the origin and faces {}",
        name, figure(done.turned_deg), axis_name(done.up), figure(done.moved.x),
        figure(done.moved.y), figure(done.moved.z), shown, axis_name(forward_axis(done.up))));
  }
}

void normalise_take(Take& take, const Arguments& arguments) {
  NormaliseSettings settings;
  settings.floor_at_zero = arguments.flag("floor_at_zero");
  settings.face_forward = arguments.flag("face_forward");
  if (!settings.floor_at_zero && !settings.face_forward) return;
  settings.names = names_of_map(arguments.text("map"));
  if (arguments.given("up")) settings.up = axis_named(arguments.text("up"));
  say_normalised(take, normalise(take, settings), arguments);
}

/// 0 where nothing tells. A guess is said, so ask once a take.
double metres_per_unit_of(const Take& take) {
  const double metres = likely_metres_per_unit(take);
  const bool is_guess = take.has_joints() && !(take.metres_per_unit > 0) && metres > 0;
  if (is_guess) {
    say(fmt::format("{}: the unit is taken to be {}: the skeleton then has the size of a person",
                    take.source.name, guess_length_unit(take.skeleton)->name));
  }
  return metres;
}

/// `metres`: in the unit of the take; 0 where it is unknown.
Take in_unit(const Take& take, const std::string& unit, double metres) {
  if (metres == 0) {
    throw Error(ErrorKind::usage, fmt::format("{}: the unit of its lengths is unknown, so they "
                                              "cannot be converted to {}",
                                              take.source.name, unit));
  }
  const double factor = metres / metres_per_unit(unit);
  if (!take.has_joints()) return scale_lengths(take, factor, unit);
  Take scaled = scale_lengths(take, factor);
  scaled.metres_per_unit = metres_per_unit(unit);
  return scaled;
}

/// The joint positions as markers, in millimetres where the unit is known.
Take as_markers(const Take& take, const Arguments& arguments) {
  const bool with_end_sites = arguments.flag("end_sites");
  const double metres = arguments.given("unit") ? 0 : metres_per_unit_of(take);
  if (metres == 0) return joint_markers(take, with_end_sites);
  return joint_markers(in_unit(take, "mm", metres), with_end_sites);
}

/// The take in the form that the format can hold.
Take fitted(Take take, const Format& format, const Arguments& arguments) {
  const bool joints = take.has_joints();
  if (joints && (format.write == nullptr || arguments.flag("positions"))) {
    return as_markers(take, arguments);
  }
  if (const std::string contents = pointless_text(take);
      !contents.empty() && format.name != take.source.format) {
    throw Error(ErrorKind::usage, fmt::format("{}: {}; {} files hold markers only",
                                              take.source.name, contents, format.name));
  }
  check_can_hold(take.source.name, take, format.name);
  // BVH has no rest rotations.
  if (joints && format.name == "bvh") {
    for (const Quat rest : take.skeleton.rest_rotations) {
      if (!(rest == Quat{})) return without_rest_rotations(take);
    }
  }
  return take;
}

/// Treats angles, forces, moments and powers as markers.
void take_all_points(Take& take) { take.is_position.clear(); }

/// AMC holds angles only; the skeleton is written to an ASF file beside it.
void check_has_place(const Take& take, const Format& format, const std::string& output) {
  if (format.name != "amc" || take.source.format == "amc" || output != "-") return;
  throw Error(ErrorKind::usage,
              "convert: AMC needs a skeleton file beside it; name an output file");
}

int run_convert(const Arguments& arguments) {
  const std::string input = arguments.positionals[0];
  const std::string output = converted_output_of(arguments);
  const bool force = arguments.flag("force");
  RunFiles()
      .reads("IN", input)
      .reads("--asf", arguments.text("asf"))
      .reads("--map", arguments.text("map"))
      .writes("OUT", output, input)
      .check();
  if (!arguments.given("to")) check_take_ending(output);
  check_free(output, force);
  TakeResult read = read_take(fs::path(input), read_options(arguments));
  warn_of_repairs(read.take.source, read.diagnostics);
  Take take = std::move(read.take);
  const Format& format = output_format(arguments, output, take);
  if (arguments.flag("plain")) drop_layout(take.source);
  if (arguments.flag("all_points")) take_all_points(take);
  if (arguments.given("fps")) take = resampled(take, arguments.number("fps"));
  if (arguments.given("up")) take = turned(take, arguments);
  if (arguments.given("unit")) {
    const double metres = metres_per_unit_of(take);
    take = in_unit(take, arguments.text("unit"), metres);
  }
  normalise_take(take, arguments);
  check_has_place(take, format, output);
  take = fitted(std::move(take), format, arguments);
  for (const std::string& line :
       loss_lines(input_name(input), take, format.name, arguments.flag("strict")))
    say_warning(line);
  write_take_output(output, take, std::string(format.name), force);
  return 0;
}

std::vector<Flag> change_flags() {
  Flag fps = number_flag("fps", "Hz", 0, least_frame_rate_hz, most_frame_rate_hz, "Change",
                         "resample the motion to this rate",
                         "Samples are interpolated, not averaged: clean a noisy take first.");
  fps.has_default = false;
  Flag up = text_flag("up", "", "Change", "turn the axes so that this axis points up");
  up.spec.choices = {"x", "y", "z"};
  Flag from_up = text_flag("from_up", "", "Change", "the axis that points up in the input",
                           "Found from the motion if not given.");
  from_up.spec.choices = {"x", "y", "z"};
  Flag unit = text_flag("unit", "", "Change", "convert lengths to this unit",
                        "Without it, joint positions that become markers are in millimetres.");
  unit.spec.choices = {"mm", "cm", "m"};
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
  Flag to = text_flag("to", "", "Output", "format to write, whatever the ending of the output");
  for (const Format& format : formats()) {
    if (format.write != nullptr || format.write_markers != nullptr)
      to.spec.choices.emplace_back(format.name);
  }
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
      "In a format of markers (c3d, trc, tsv), joints become markers at their positions. The "
      "skeleton of an AMC file is written beside it, as an ASF file of the same name.";
  command.positionals = {{"IN", "take to read; - is standard input", 1, 1, {}},
                         {"OUT", "file to write; - is standard output", 0, 1, {}}};
  command.flags = {output_flag("the same as OUT"), to};
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
  append(command.flags, reading_flags("make every repair, and everything that is lost, an error"));
  command.examples = {
      {"kinemend convert odd.bvh plain.bvh --plain",
       "a file that other programs cannot read, in the plainest form"},
      {"kinemend convert 35_01.amc 35_01.bvh", "the skeleton is 35.asf in the same folder"},
      {"kinemend convert walk.c3d walk.trc --up y --unit m", "for OpenSim"},
      {"kinemend convert walk.bvh walk.glb", "for viewers and game engines"},
      {"kinemend convert walk.bvh home.bvh --floor-at-zero --face-forward",
       "feet at height 0, start at the origin"}};
  command.run = run_convert;
  return command;
}

}  // namespace kinemend::cli
