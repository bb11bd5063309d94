// kinemend info: what is in a take.

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "json.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/io.hpp"
#include "kinemend/metrics.hpp"
#include "kinemend/version.hpp"
#include "table.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

struct Take {
  std::string name;
  ReadResult read;
  std::optional<CleanReport> noise;
};

std::size_t channel_count(const Skeleton& skeleton) {
  std::size_t count = 0;
  for (const auto& channels : skeleton.channels) count += channels.size();
  return count;
}

std::string_view format_description(const Clip& clip) {
  for (const Format& format : formats()) {
    if (format.name == clip.source.format) return format.description;
  }
  return "unknown format";
}

std::string channel_names(const std::vector<Channel>& channels) {
  static constexpr std::string_view names[] = {"Xpos", "Ypos", "Zpos", "Xrot", "Yrot", "Zrot"};
  std::vector<std::string_view> parts;
  parts.reserve(channels.size());
  for (const Channel channel : channels) parts.push_back(names[static_cast<std::size_t>(channel)]);
  return fmt::format("{}", fmt::join(parts, " "));
}

std::vector<std::size_t> depths(const Skeleton& skeleton) {
  std::vector<std::size_t> result(skeleton.joint_count(), 0);
  for (std::size_t j = 0; j < result.size(); ++j) {
    if (skeleton.parents[j] >= 0)
      result[j] = result[static_cast<std::size_t>(skeleton.parents[j])] + 1;
  }
  return result;
}

std::string tree_text(const Skeleton& skeleton) {
  const std::vector<std::size_t> depth = depths(skeleton);
  std::string text = "\n";
  Table table({Align::left, Align::left}, 4);
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    // Deep chains are shown, not drawn out to any width.
    const std::string indent(2 * std::min<std::size_t>(depth[j], 40), ' ');
    table.add({indent + printable(skeleton.names[j]), channel_names(skeleton.channels[j])});
  }
  return text + table.text();
}

std::string noise_text(const CleanReport& report) {
  Table table({Align::left, Align::right, Align::right}, 4);
  table.add({"joint", "noise deg", "samples to repair"});
  for (const JointSummary& joint : report.joints) {
    table.add({printable(joint.name), figure(joint.noise_deg), grouped(joint.frames_repaired)});
  }
  return "\n" + table.text();
}

std::string unit_text(const Clip& clip) {
  const double height = skeleton_height(clip.skeleton);
  const auto unit = guess_length_unit(clip.skeleton);
  if (!unit) return fmt::format("unknown (the skeleton measures {})", figure(height));
  return fmt::format("probably {} (the skeleton measures {}, {} m)", unit->name, figure(height),
                     figure(height * unit->metres));
}

std::string take_text(const Take& take, bool with_tree) {
  const Clip& clip = take.read.clip;
  std::string text = Colours::of_out().paint(Paint::bold, printable(take.name)) + "\n";
  Table table({Align::left, Align::left});
  table.add({"format", fmt::format("{} ({})", clip.source.format, format_description(clip))});
  table.add({"joints", fmt::format("{} ({}, {})", clip.joint_count(),
                                   counted(channel_count(clip.skeleton), "channel"),
                                   counted(clip.skeleton.end_sites.size(), "end site"))});
  table.add({"length", length_text(clip.frame_count(), clip.frame_rate_hz)});
  table.add({"unit", unit_text(clip)});
  if (clip.frame_count() > 0) {
    table.add({"calibration", leading_calibration_frames(clip) > 0
                                  ? "frame 1 is a calibration pose and no part of the motion"
                                  : "none"});
  }
  for (const Diagnostic& entry : take.read.diagnostics.entries())
    table.add({"repaired", printable(diagnostic_line("line", entry))});
  text += table.text();
  if (with_tree) text += tree_text(clip.skeleton);
  if (take.noise) text += noise_text(*take.noise);
  return text;
}

Json joints_json(const Take& take) {
  const Skeleton& skeleton = take.read.clip.skeleton;
  Json joints = Json::array();
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    Json joint = {{"name", skeleton.names[j]},
                  {"parent", skeleton.parents[j]},
                  {"channels", channel_names(skeleton.channels[j])}};
    if (take.noise) {
      joint["noise_deg"] = take.noise->joints[j].noise_deg;
      joint["samples_to_repair"] = take.noise->joints[j].frames_repaired;
    }
    joints.push_back(std::move(joint));
  }
  return joints;
}

Json take_json(const Take& take) {
  const Clip& clip = take.read.clip;
  const auto unit = guess_length_unit(clip.skeleton);
  return {{"input", take.name},
          {"format", clip.source.format},
          {"joint_count", clip.joint_count()},
          {"channel_count", channel_count(clip.skeleton)},
          {"end_site_count", clip.skeleton.end_sites.size()},
          {"frames", clip.frame_count()},
          {"frame_rate_hz", clip.frame_rate_hz},
          {"duration_s", clip.duration_s()},
          {"calibration_frames", leading_calibration_frames(clip)},
          {"height", skeleton_height(clip.skeleton)},
          {"unit_guess", unit ? Json(unit->name) : Json()},
          {"metres_per_unit", unit ? Json(unit->metres) : Json()},
          {"diagnostics", json_of(take.read.diagnostics)},
          {"joints", joints_json(take)}};
}

int run(const Arguments& arguments) {
  const bool json = arguments.flag("json");
  check_single_use(arguments.positionals, {}, json);
  Json takes = Json::array();
  int code = 0;
  for (const std::string& input : arguments.positionals) {
    try {
      Take take{input_name(input), read_clip(std::filesystem::path(input), read_options(arguments)),
                std::nullopt};
      if (arguments.flag("noise"))
        take.noise = clean_clip(take.read.clip, *make_cleaner("auto"), {}, "auto").report;
      if (json) {
        takes.push_back(take_json(take));
      } else {
        write_out(take_text(take, arguments.flag("tree")));
      }
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::cannot_write) throw;
      say_error(error.what());
      code = std::max(code, static_cast<int>(error.kind()));
      takes.push_back({{"input", input},
                       {"error", error.what()},
                       {"exit_code", static_cast<int>(error.kind())}});
    }
  }
  if (json) write_out(json_text({{"kinemend", version()}, {"takes", std::move(takes)}}));
  return code;
}

}  // namespace

Command info_command() {
  Command command;
  command.name = "info";
  command.summary = "say what is in a take";
  command.description =
      "Joints, frames, rate, duration, the probable unit of length, whether the first frame is a "
      "calibration pose, and what the reader had to repair. The unit is that in which the skeleton "
      "is a person of 1 to 2.5 m.";
  command.positionals = {{"FILE", "take to look at; - is standard input", 1, 1000000, {}}};
  command.flags = {
      json_flag("print JSON instead of text"),
      switch_flag("tree", "Output", "also show the skeleton with its channels"),
      switch_flag("noise", "Output", "also estimate the noise of each joint",
                  "By a dry run of the method auto: jitter per axis, and samples it would repair."),
      from_flag(), strict_flag("what needs a repair becomes an error")};
  command.examples = {{"kinemend info walk.bvh --tree", "the skeleton too"},
                      {"kinemend info *.bvh --json", "for programs"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
