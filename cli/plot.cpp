// kinemend plot: draws pictures of takes, without a browser.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "frame_range.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/io.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// The kind of picture and the part of the take it shows.
struct Drawing {
  std::string what;
  std::string track;  ///< empty: the track that differs or moves most
  bool is_position = false;
  std::optional<FrameRange> range;
  std::size_t poses = 9;
};

TrackCurves curves_of(const Take& before, const Take& after, std::size_t track, bool is_position) {
  if (!before.has_joints()) return marker_curves(before, after, track);
  return is_position ? root_curves(before, after) : rotation_curves(before, after, track);
}

std::optional<std::size_t> track_named(const Take& take, const std::string& name) {
  const auto track = take.has_joints() ? take.skeleton.find(name) : take.find(name);
  return track < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(track));
}

// How much the curves show: the difference of two takes, or the range of a single one.
double weight_of(const TrackCurves& curves, bool two) {
  double sum = 0;
  if (two) {
    for (const double value : curves.difference) sum += std::isfinite(value) ? value * value : 0;
    return sum;
  }
  for (const std::vector<double>& axis : curves.after) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : axis) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (low <= high) sum += high - low;
  }
  return sum;
}

TrackCurves chosen_curves(const Take& before, const Take& after, bool two, const Drawing& drawing) {
  if (!drawing.track.empty()) {
    const auto track = track_named(before, drawing.track);
    if (!track)
      throw Error(ErrorKind::usage,
                  fmt::format("plot: no joint or marker is called {}", drawing.track));
    return curves_of(before, after, *track, drawing.is_position);
  }
  if (before.owner_count() == 0) throw Error(ErrorKind::usage, "plot: the take has no tracks");
  if (drawing.is_position) return curves_of(before, after, 0, true);
  TrackCurves best = curves_of(before, after, 0, false);
  for (std::size_t track = 1; track < before.owner_count(); ++track) {
    TrackCurves other = curves_of(before, after, track, false);
    if (weight_of(other, two) > weight_of(best, two)) best = std::move(other);
  }
  return best;
}

std::string picture(const Take& before, const Take* other, const Drawing& drawing) {
  const Take& after = other != nullptr ? *other : before;
  const bool two = other != nullptr;
  std::pair<std::size_t, std::size_t> frames{0, std::numeric_limits<std::size_t>::max()};
  if (drawing.range)
    frames = frames_of(*drawing.range, before.frame_count(), before.frame_rate_hz,
                       first_frame_number(before));
  if (drawing.what == "strip") return film_strip_svg(before, other, frames, drawing.poses);
  if (drawing.what == "motion") return moving_picture_svg(before, other, frames);
  const TrackCurves curves = chosen_curves(before, after, two, drawing);
  if (drawing.what == "spectrum") return spectrum_svg(curves, !two);
  CurveStyle style;
  style.first_frame = frames.first;
  style.last_frame = frames.second;
  style.one_take = !two;
  return curves_svg(curves, style);
}

Drawing drawing_of(const Arguments& arguments) {
  Drawing drawing;
  drawing.what = arguments.text("what");
  const std::vector<std::string> names = joints_of(arguments);
  if (names.size() > 1)
    throw Error(ErrorKind::usage, "plot: --joints and --markers take one name, of what is drawn");
  if (!names.empty()) drawing.track = names.front();
  drawing.is_position = arguments.flag("root_position");
  drawing.poses = static_cast<std::size_t>(arguments.whole("poses"));
  if (const std::string range = arguments.text("range"); !range.empty())
    drawing.range = parse_range(range);
  return drawing;
}

int run_plot(const Arguments& arguments) {
  const std::vector<std::string>& inputs = arguments.positionals;
  std::string output = arguments.text("output");
  if (output.empty())
    throw Error(ErrorKind::usage, "plot: --output is missing (see kinemend plot -h)");
  const bool force = arguments.flag("force");
  RunFiles()
      .reads("IN", inputs)
      .reads("--asf", arguments.text("asf"))
      .writes("--output", output)
      .check();
  check_only_ending(output, ".svg");
  check_free(output, force);
  const Drawing drawing = drawing_of(arguments);
  const ReadOptions reading = read_options(arguments);
  const Take before = read_and_warn(inputs[0], reading).take;
  std::optional<Take> after;
  if (inputs.size() > 1) after = read_and_warn(inputs[1], reading).take;
  if (after && after->has_joints() != before.has_joints()) {
    throw Error(ErrorKind::usage, fmt::format("plot: {} and {} are not both joints or both markers",
                                              inputs[0], inputs[1]));
  }
  write_output(output, picture(before, after ? &*after : nullptr, drawing), force);
  return 0;
}

}  // namespace

Command plot_command() {
  std::vector<Flag> joints =
      joints_flags("Drawing", "joint or marker of curves and spectrum", "track");
  for (Flag& flag : joints) {
    flag.value_name = "NAME";
    flag.details.clear();
  }
  Command command;
  command.name = "plot";
  command.summary = "draw a take, or two over each other, as SVG";
  command.description =
      "Draws curves of a joint or marker (--what curves), poses along the time (strip), the body "
      "in motion (motion, which browsers play), or power over frequency (spectrum). With OTHER "
      "both takes are drawn: TAKE as the one before, OTHER as the one after.\n\n"
      "Where no --joints is named it is the one that differs most between the two, or of one take "
      "the one that moves most.";
  command.positionals = {{"TAKE", "take to draw; - is standard input", 1, 1, {}},
                         {"OTHER", "the same take after something was done", 0, 1, {}}};
  command.flags = {
      output_flag("where to write; - is standard output"),
      force_flag(),
      choice_flag("what", "Drawing", "what to draw", {"curves", "strip", "motion", "spectrum"},
                  "curves"),
      std::move(joints[0]),
      std::move(joints[1]),
      switch_flag("root_position", "Drawing", "curves of the root's position, not of a rotation"),
      text_flag("range", "FIRST:LAST", "Drawing",
                "draw frames 121:240, as the file numbers them, or seconds 1s:2.5s",
                "For curves, strip and motion. Either end may be left out."),
      whole_flag("poses", 9, 1, 60, "Drawing", "poses of a strip")};
  append(command.flags, reading_flags());
  command.examples = {
      {"kinemend plot raw.bvh clean.bvh -o curves.svg --joints LeftForeArm", "before and after"},
      {"kinemend plot walk.bvh -o strip.svg --what strip", "the motion on one line"},
      {"kinemend plot raw.bvh clean.bvh -o walk.svg --what motion --range 1s:4s",
       "both in motion, side by side"}};
  command.run = run_plot;
  return command;
}

}  // namespace kinemend::cli
