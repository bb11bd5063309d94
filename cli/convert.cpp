// kinemend convert: reads one format and writes another, or the same anew.

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/frame_rate.hpp"
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

/// --to, else by the output's extension, else the input's own.
const Format& output_format(const Arguments& arguments, const std::string& output,
                            const Take& take) {
  if (const std::string format = arguments.text("to"); !format.empty()) return format_named(format);
  if (output == "-") return format_named(source_of(take).format);
  if (const Format* format = format_of_path(output)) return *format;
  throw Error(
      ErrorKind::usage,
      fmt::format("convert: {} has the extension of no format; name one with --to", output));
}

Axis axis_named(const std::string& name) {
  return name == "x" ? Axis::x : name == "y" ? Axis::y : Axis::z;
}

std::string_view axis_name(Axis axis) {
  return axis == Axis::x ? "x" : axis == Axis::y ? "y" : "z";
}

Take resampled(const Take& take, double frame_rate_hz) {
  if (const std::string contents = pointless_text(take); !contents.empty())
    say(fmt::format("{}: {}: --fps changes nothing", source_of(take).name, contents));
  return std::visit([&](const auto& clip) { return Take(resample(clip, frame_rate_hz)); }, take);
}

/// What was up is taken from --from-up, else from the motion, and said.
Take turned(const Take& take, const Arguments& arguments) {
  const Axis to = axis_named(arguments.text("up"));
  const std::string stated = arguments.text("from_up");
  const Axis from = stated.empty()
                        ? std::visit([](const auto& clip) { return guess_up_axis(clip); }, take)
                        : axis_named(stated);
  if (stated.empty()) {
    say(fmt::format("{}: {} is taken for the vertical axis (--from-up says otherwise)",
                    source_of(take).name, axis_name(from)));
  }
  return std::visit([&](const auto& clip) { return Take(turn_axes(clip, from, to)); }, take);
}

double metres_per_unit_of(const Take& take) {
  if (const auto* markers = std::get_if<MarkerClip>(&take)) return metres_per_unit(markers->unit);
  const Clip& clip = std::get<Clip>(take);
  if (clip.metres_per_unit > 0) return clip.metres_per_unit;
  const auto guess = guess_length_unit(clip.skeleton);
  if (!guess) return 0;
  say(fmt::format("{}: lengths are taken for {}, since the skeleton then is a person",
                  source_of(take).name, guess->name));
  return guess->metres;
}

Take in_unit(const Take& take, const std::string& unit) {
  const double metres = metres_per_unit_of(take);
  if (metres == 0) {
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: the unit of its lengths is not known, so that there is no way to {}",
                    source_of(take).name, unit));
  }
  const double factor = metres / metres_per_unit(unit);
  if (const auto* markers = std::get_if<MarkerClip>(&take)) {
    return scale_lengths(*markers, factor, unit);
  }
  Clip scaled = scale_lengths(std::get<Clip>(take), factor);
  scaled.metres_per_unit = metres_per_unit(unit);
  return scaled;
}

/// Joints become the markers that a format of markers can hold, in millimetres where the size of
/// the unit is known.
Take as_markers(const Take& take, const Arguments& arguments) {
  Take scaled = take;
  if (!arguments.given("unit") && metres_per_unit_of(take) > 0) scaled = in_unit(take, "mm");
  return joint_markers(std::get<Clip>(scaled), arguments.flag("end_sites"));
}

/// The take as the format can hold it.
Take fitted(Take take, const Format& format, const Arguments& arguments) {
  const bool joints = std::holds_alternative<Clip>(take);
  if (joints && (format.write == nullptr || arguments.flag("positions"))) {
    return as_markers(take, arguments);
  }
  if (const std::string contents = pointless_text(take);
      !contents.empty() && format.name != source_of(take).format) {
    throw Error(ErrorKind::usage, fmt::format("{}: {}; {} files hold nothing else",
                                              source_of(take).name, contents, format.name));
  }
  if (!joints && format.write_markers == nullptr) {
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: holds markers; {} files hold joints, which markers alone do not give",
                    source_of(take).name, format.name));
  }
  // BVH and glTF have no frames of rest of their own.
  if (joints && format.name == "bvh") {
    const Clip& clip = std::get<Clip>(take);
    for (const Quat rest : clip.skeleton.rest_rotations) {
      if (!(rest == Quat{})) return without_rest_rotations(clip);
    }
  }
  return take;
}

/// Angles, forces, moments and powers go along as if they were markers.
void take_all_points(Take& take) {
  if (auto* markers = std::get_if<MarkerClip>(&take)) markers->is_position.clear();
}

/// AMC holds angles only; the skeleton goes to an ASF file beside it.
void check_has_place(const Take& take, const Format& format, const std::string& output) {
  if (format.name != "amc" || source_of(take).format == "amc" || output != "-") return;
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
      .writes("OUT", output, input)
      .check();
  check_free(output, force);
  TakeResult read = read_take(fs::path(input), read_options(arguments));
  warn_of_repairs(source_of(read.take), read.diagnostics);
  Take take = std::move(read.take);
  const Format& format = output_format(arguments, output, take);
  if (arguments.flag("plain")) drop_layout(source_of(take));
  if (arguments.flag("all_points")) take_all_points(take);
  if (arguments.given("fps")) take = resampled(take, arguments.number("fps"));
  if (arguments.given("up")) take = turned(take, arguments);
  if (arguments.given("unit")) take = in_unit(take, arguments.text("unit"));
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
                         "bring the motion to this rate",
                         "Samples are interpolated, not averaged; clean a noisy take first.");
  fps.has_default = false;
  Flag up = text_flag("up", "", "Change", "turn the axes so that this one points up");
  up.spec.choices = {"x", "y", "z"};
  Flag from_up = text_flag("from_up", "", "Change", "what points up in the input",
                           "Found from the motion where it is not given.");
  from_up.spec.choices = {"x", "y", "z"};
  Flag unit = text_flag("unit", "", "Change", "bring lengths to this unit",
                        "Joint positions that become markers are in millimetres without it.");
  unit.spec.choices = {"mm", "cm", "m"};
  return {std::move(fps), std::move(up), std::move(from_up), std::move(unit)};
}

}  // namespace

Command convert_command() {
  Flag to =
      text_flag("to", "", "Output", "format to write, where the output's extension does not tell");
  for (const Format& format : formats()) {
    if (format.write != nullptr || format.write_markers != nullptr)
      to.spec.choices.emplace_back(format.name);
  }
  Command command;
  command.name = "convert";
  command.summary = "write a take in another format, or anew in its own";
  command.description = "Formats there are: ";
  for (const Format& format : formats()) {
    if (command.description.back() != ' ') command.description += ", ";
    command.description += fmt::format("{} ({})", format.name, format.description);
  }
  command.description +=
      ". Within one format the source's layout and digits stay, unless --plain asks for the "
      "program's own. Rate, axes and units stay unless they are asked for. What a file holds "
      "beside "
      "its motion (analog channels, force plates, events) goes along where the format has a place "
      "for it; what stays behind is said, and an error under --strict.\n\n"
      "Joints that go to a format of markers (c3d, trc) become the joints' positions. An AMC file "
      "gets its skeleton beside it, as an ASF file of the same name.";
  command.positionals = {{"IN", "take to read; - is standard input", 1, 1, {}},
                         {"OUT", "where to write; - is standard output", 0, 1, {}}};
  command.flags = {output_flag("the same as OUT"), to};
  append(command.flags, change_flags());
  command.flags.push_back(switch_flag("positions", "Change",
                                      "write the positions of joints as markers",
                                      "For formats that could hold the joints themselves (csv)."));
  command.flags.push_back(
      switch_flag("end_sites", "Change", "with the positions of joints, those of end sites too"));
  command.flags.push_back(
      switch_flag("all_points", "Change",
                  "write a C3D file's angles, forces, moments and powers as markers, too",
                  "Without it they stay out of TRC, TSV and CSV, and are named."));
  command.flags.push_back(
      switch_flag("plain", "Output", "drop the source's layout and write anew",
                  "What the file holds stays: a C3D file keeps analog channels and parameters."));
  command.flags.push_back(force_flag());
  append(command.flags, reading_flags("what needs a repair, or would be lost, becomes an error"));
  command.examples = {
      {"kinemend convert odd.bvh plain.bvh --plain",
       "a file that other programs cannot read, in its plainest form"},
      {"kinemend convert 35_01.amc 35_01.bvh", "with the skeleton of 35.asf beside it"},
      {"kinemend convert walk.c3d walk.trc --up y --unit m", "for OpenSim"},
      {"kinemend convert walk.bvh walk.glb", "for viewers and game engines"}};
  command.run = run_convert;
  return command;
}

}  // namespace kinemend::cli
