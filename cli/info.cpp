// kinemend info: prints the content of takes and models.

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "json.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"
#include "kinemend/take.hpp"
#include "model_view.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

struct Looked {
  std::string name;
  TakeResult read;
  /// With --noise: the estimate of the method auto for each joint or marker.
  struct Noise {
    std::string name;
    double level = 0;  ///< degrees, or file units
    std::size_t to_repair = 0;
  };
  std::vector<Noise> noise = {};
};

std::size_t channel_count(const Skeleton& skeleton) {
  std::size_t count = 0;
  for (const auto& channels : skeleton.channels) count += channels.size();
  return count;
}

std::string format_text(const SourceInfo& source) {
  for (const Format& format : formats()) {
    if (format.name == source.format)
      return fmt::format("{} ({})", source.format, format.description);
  }
  return "unknown";
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
    // The indent of deep chains is limited.
    const std::string indent(2 * std::min<std::size_t>(depth[j], 40), ' ');
    table.add({indent + printable_name(skeleton.names[j]), channel_names(skeleton.channels[j])});
  }
  return text + table.text();
}

std::string noise_text(const Looked& subject, const std::string& kind, const std::string& unit) {
  Table table({Align::left, Align::right, Align::right}, 4);
  table.add({kind, "noise " + unit, "samples to repair"});
  for (const Looked::Noise& track : subject.noise)
    table.add({printable_name(track.name), figure(track.level), grouped(track.to_repair)});
  return "\n" + table.text();
}

std::string unit_text(const Take& clip) {
  const double height = body_height(clip.skeleton);
  if (clip.metres_per_unit > 0) {
    return fmt::format("{} m (the skeleton measures {}, {} m)", figure(clip.metres_per_unit),
                       figure(height), figure(height * clip.metres_per_unit));
  }
  const auto unit = guess_length_unit(clip.skeleton);
  if (!unit) return fmt::format("unknown (the skeleton measures {})", figure(height));
  return fmt::format("probably {} (the skeleton measures {}, {} m)", unit->name, figure(height),
                     figure(height * unit->metres));
}

/// `has_subjects` means that the table already has a row of subjects.
void add_facts(const Looked& subject, const SourceInfo& source, bool has_subjects, Table& table) {
  for (const SourceFact& fact : source.facts) {
    const bool is_said = fact.name == "analog frames" || fact.name == "first frame" ||
                         (fact.name == "subjects" && has_subjects);
    if (!is_said) table.add({printable(fact.name), printable(fact.text)});
  }
  for (const Diagnostic& entry : subject.read.diagnostics.entries())
    table.add({"repaired", printable(diagnostic_text(source.format, entry))});
}

std::string numbered_length(const Take& clip) {
  const std::string length = length_text(clip.frame_count(), clip.frame_rate_hz);
  const std::int64_t first = first_frame_number(clip);
  return first == 1 ? length : fmt::format("{}, from frame {}", length, first);
}

/// "Ann (41 markers), Bob (39 markers)" for several people; empty for one.
std::string people_text(const Take& clip) {
  const std::vector<Subject> people = subjects_of(clip);
  if (people.size() < 2) return "";
  std::vector<std::string> parts;
  parts.reserve(people.size());
  for (const Subject& person : people) {
    parts.push_back(fmt::format("{} ({})",
                                person.name.empty() ? "no subject" : printable_name(person.name),
                                counted(person.markers.size(), "marker")));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// The missing samples of joints or markers.
struct Missing {
  std::vector<std::size_t> samples;  // per joint or marker
  std::size_t gaps = 0, longest = 0, all = 0, possible = 0;
};

Missing missing_in(const std::vector<Gap>& gaps, std::size_t tracks) {
  Missing missing{std::vector<std::size_t>(tracks), 0, 0, 0, 0};
  for (const Gap& gap : gaps) {
    missing.samples[gap.track] += gap.length();
    missing.longest = std::max(missing.longest, gap.length());
    missing.all += gap.length();
    ++missing.gaps;
  }
  return missing;
}

Missing missing_of(const Take& take) {
  Missing missing = missing_in(find_gaps(take), take.owner_count());
  missing.possible =
      take.frame_count() * (take.has_joints() ? take.joint_count() : take.position_count());
  return missing;
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string missing_text(const Missing& missing, double frame_rate_hz) {
  if (missing.gaps == 0) return "nothing";
  return fmt::format("{:.2f} % in {}, the longest {} ({:.2f} s)",
                     percent(missing.all, missing.possible), counted(missing.gaps, "gap"),
                     counted(missing.longest, "frame"),
                     static_cast<double>(missing.longest) / frame_rate_hz);
}

std::string joints_text(const Looked& subject, const Take& clip, bool with_tree) {
  Table table({Align::left, Align::left});
  table.add({"format", format_text(clip.source)});
  table.add({"joints", fmt::format("{} ({}, {})", clip.joint_count(),
                                   counted(channel_count(clip.skeleton), "channel"),
                                   counted(clip.skeleton.end_sites.size(), "end site"))});
  const std::int64_t first = first_frame_number(clip);
  table.add({"length", numbered_length(clip)});
  table.add({"unit", unit_text(clip)});
  if (clip.frame_count() > 0) {
    table.add({"calibration", leading_calibration_frames(clip) > 0
                                  ? fmt::format("frame {} is a calibration pose, not part of "
                                                "the motion",
                                                first)
                                  : "none"});
  }
  if (const Missing missing = missing_of(clip); missing.gaps > 0)
    table.add({"missing", missing_text(missing, clip.frame_rate_hz)});
  add_facts(subject, clip.source, false, table);
  std::string text = table.text();
  if (with_tree) text += tree_text(clip.skeleton);
  if (!subject.noise.empty()) text += noise_text(subject, "joint", "deg");
  return text;
}

std::string markers_text(const Looked& subject, const Take& clip, bool with_tree) {
  const Missing missing = missing_of(clip);
  const std::size_t positions = clip.position_count();
  Table table({Align::left, Align::left});
  table.add({"format", format_text(clip.source)});
  std::string markers = grouped(positions);
  if (positions < clip.marker_count()) {
    markers += fmt::format(" (and {} that hold angles, forces and the like)",
                           counted(clip.marker_count() - positions, "point"));
  }
  table.add({"markers", markers});
  const std::string contents = pointless_text(subject.read.take);
  table.add({"length", contents.empty() ? numbered_length(clip) : contents});
  table.add({"unit", clip.unit.empty() ? "not stated" : printable_name(clip.unit)});
  if (contents.empty()) table.add({"missing", missing_text(missing, clip.frame_rate_hz)});
  const std::string people = people_text(clip);
  if (!people.empty()) table.add({"subjects", people});
  add_facts(subject, clip.source, !people.empty(), table);
  std::string text = table.text();
  if (!subject.noise.empty()) text += noise_text(subject, "marker", clip.unit);
  if (!with_tree) return text;
  Table list({Align::left, Align::right}, 4);
  list.add({"marker", "missing %"});
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    const double share = percent(missing.samples[m], clip.frame_count());
    list.add({printable_name(clip.names[m]),
              clip.holds_positions(m) ? fmt::format("{:.2f}", share) : "not a position"});
  }
  return text + "\n" + list.text();
}

std::string subject_text(const Looked& subject, bool with_tree) {
  const std::string name = Colours::of_out().paint(Paint::bold, printable(subject.name)) + "\n";
  const Take& take = subject.read.take;
  return name + (take.has_joints() ? joints_text(subject, take, with_tree)
                                   : markers_text(subject, take, with_tree));
}

Json joints_json(const Looked& subject, const Skeleton& skeleton) {
  Json joints = Json::array();
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    Json joint = {{"name", skeleton.names[j]},
                  {"parent", skeleton.parents[j]},
                  {"channels", channel_names(skeleton.channels[j])}};
    if (!subject.noise.empty()) {
      joint["noise_deg"] = subject.noise[j].level;
      joint["samples_to_repair"] = subject.noise[j].to_repair;
    }
    joints.push_back(std::move(joint));
  }
  return joints;
}

Json facts_json(const SourceInfo& source) {
  Json facts = Json::object();
  for (const SourceFact& fact : source.facts) facts[fact.name] = fact.text;
  return facts;
}

Json joints_take_json(const Looked& subject, const Take& clip) {
  const auto unit = guess_length_unit(clip.skeleton);
  const double stated = clip.metres_per_unit;
  const Missing missing = missing_of(clip);
  return {{"input", subject.name},
          {"format", clip.source.format},
          {"kind", "joints"},
          {"joint_count", clip.joint_count()},
          {"channel_count", channel_count(clip.skeleton)},
          {"end_site_count", clip.skeleton.end_sites.size()},
          {"frames", clip.frame_count()},
          {"first_frame", first_frame_number(clip)},
          {"frame_rate_hz", clip.frame_rate_hz},
          {"duration_s", clip.duration_s()},
          {"calibration_frames", leading_calibration_frames(clip)},
          {"height", body_height(clip.skeleton)},
          {"unit_guess", unit ? Json(unit->name) : Json()},
          {"metres_per_unit", stated > 0 ? Json(stated)
                              : unit     ? Json(unit->metres)
                                         : Json()},
          {"facts", facts_json(clip.source)},
          {"diagnostics", json_of(subject.read.diagnostics, clip.source.format)},
          {"missing_samples", missing.all},
          {"gaps", missing.gaps},
          {"longest_gap_frames", missing.longest},
          {"joints", joints_json(subject, clip.skeleton)}};
}

Json markers_json(const Looked& subject, const Take& clip) {
  const Missing missing = missing_of(clip);
  const double metres = metres_per_unit(clip.unit);
  Json markers = Json::array();
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    Json marker = {{"name", clip.names[m]},
                   {"is_position", clip.holds_positions(m)},
                   {"missing_frames", missing.samples[m]}};
    if (!subject.noise.empty()) {
      marker["noise"] = subject.noise[m].level;
      marker["samples_to_repair"] = subject.noise[m].to_repair;
    }
    markers.push_back(std::move(marker));
  }
  Json people = Json::array();
  for (const Subject& person : subjects_of(clip))
    people.push_back({{"name", person.name}, {"markers", person.markers.size()}});
  Json events = Json::array();
  for (const MarkerEvent& event : clip.events) {
    events.push_back(
        {{"label", event.label}, {"context", event.context}, {"time_s", event.time_s}});
  }
  return {{"input", subject.name},
          {"format", clip.source.format},
          {"kind", "markers"},
          {"marker_count", clip.marker_count()},
          {"frames", clip.frame_count()},
          {"first_frame", clip.first_frame},
          {"frame_rate_hz", clip.frame_rate_hz},
          {"duration_s", clip.duration_s()},
          {"unit", clip.unit},
          {"metres_per_unit", metres > 0 ? Json(metres) : Json()},
          {"missing_samples", missing.all},
          {"gaps", missing.gaps},
          {"longest_gap_frames", missing.longest},
          {"facts", facts_json(clip.source)},
          {"subjects", std::move(people)},
          {"events", std::move(events)},
          {"diagnostics", json_of(subject.read.diagnostics, clip.source.format)},
          {"markers", std::move(markers)}};
}

Json subject_json(const Looked& subject) {
  const Take& take = subject.read.take;
  return take.has_joints() ? joints_take_json(subject, take) : markers_json(subject, take);
}

void measure_noise(Looked& subject) {
  const auto cleaner = make_cleaner("auto");
  const CleanReport report = clean_take(subject.read.take, *cleaner).report;
  for (const TrackSummary& track : report.tracks)
    subject.noise.push_back({track.name, track.noise, track.frames_repaired});
}

int run_info(const Arguments& arguments) {
  const bool json = arguments.flag("json");
  RunFiles().reads("FILE", arguments.positionals).check(json);
  Json takes = Json::array();
  const auto look_at = [&](const std::string& input) {
    if (is_model_path(input)) {
      const ModelFile file = model_file_of(read_file(input), input);
      if (json) {
        takes.push_back(model_json(file));
      } else {
        write_out(model_text(file, arguments.flag("tree")));
      }
      return 0;
    }
    Looked subject{input_name(input),
                   read_take(std::filesystem::path(input), read_options(arguments))};
    if (arguments.flag("noise")) measure_noise(subject);
    if (json) {
      takes.push_back(subject_json(subject));
    } else {
      write_out(subject_text(subject, arguments.flag("tree")));
    }
    return 0;
  };
  const int code = for_each_input(arguments.positionals, look_at, [&](const std::string& entry) {
    takes.push_back(parse_json<Json>(entry));
  });
  if (json) write_out(json_text({{"kinemend", version()}, {"takes", std::move(takes)}}));
  return code;
}

}  // namespace

Command info_command() {
  Command command;
  command.name = "info";
  command.summary = "show the content of a take or a model";
  command.description =
      "Shows joints or markers, frames, rate, duration, the unit of length, missing samples, the "
      "other contents of the file, and the repairs that reading needed. Where the file states no "
      "unit, it is the unit in which the skeleton is a person of 1.2 to 2.5 m.\n\nFor a learned "
      "model (*.kmodel) it shows the card, and with --tree the body that the model knows.";
  command.positionals = {{"FILE", "take or model to show; - is standard input", 1, 1000000, {}}};
  command.flags = {
      json_flag("print JSON instead of text"),
      switch_flag("tree", "Output", "also show the skeleton with its channels, or the markers"),
      switch_flag("noise", "Output", "also estimate the noise of each joint or marker",
                  "A dry run of the method auto gives the jitter per axis and the samples that it "
                  "would repair.")};
  append(command.flags, reading_flags());
  command.examples = {{"kinemend info walk.bvh --tree", "with the skeleton"},
                      {"kinemend info trial.c3d", "markers, gaps, analog channels, events"},
                      {"kinemend info *.bvh --json", "as JSON, for programs"}};
  command.run = run_info;
  return command;
}

}  // namespace kinemend::cli
