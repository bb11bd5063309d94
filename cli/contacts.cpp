// kinemend contacts: writes the times when feet stand, as a file to edit.

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

// Contacts of joints with what clean --feet auto would hold; those of markers, which stay where
// they are.
FeetReport report_of(const Take& clip, const KnownNames& names) {
  if (clip.has_joints()) {
    Take copy = clip;
    FeetSettings settings;
    settings.names = names;
    return clean_feet(copy, settings);
  }
  FootStands stands = find_stands(clip, {}, names);
  FeetReport report;
  report.sides = std::move(stands.sides);
  report.frame_rate_hz = clip.frame_rate_hz;
  report.time = stands.time;
  report.contacts = std::move(stands.contacts);
  const std::size_t count = report.contacts.size();
  report.held.assign(count, 0);
  report.still.assign(count, 1);
  report.reasons.assign(count, "markers are measured points and stay where they are");
  return report;
}

std::vector<NamedCurve> curves_of(const FeetReport& report, const Take& clip) {
  std::vector<NamedCurve> curves;
  std::vector<std::vector<double>> values = contact_curves(report, clip.frame_count());
  for (std::size_t l = 0; l < values.size(); ++l)
    curves.push_back({contact_curve_name(report.sides[l]), std::move(values[l])});
  return curves;
}

// A row for each frame: its number, its time from the first, and whether each foot stands.
std::string curves_csv(const Take& clip, const std::vector<NamedCurve>& curves) {
  std::string text = "frame,time_s";
  for (const NamedCurve& curve : curves) text += "," + curve.name;
  text += "\n";
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    text += fmt::format("{},{:.6g}", frame_number(f, first_frame_number(clip)),
                        static_cast<double>(f) / clip.frame_rate_hz);
    for (const NamedCurve& curve : curves) text += fmt::format(",{:g}", curve.values[f]);
    text += "\n";
  }
  return text;
}

std::string json_of_contacts(const Take& clip, const FeetReport& report, const std::string& input,
                             const std::string& output) {
  Report about{take_facts(clip), report};
  about.take.input = input;
  about.take.output = output;
  const std::vector<std::string> takes = {to_json(about)};
  return report_document("contacts", takes);
}

std::string contents_of(const std::string& to, const Take& clip, const FeetReport& report,
                        const std::string& input, const std::string& output) {
  if (to == "csv") return curves_csv(clip, curves_of(report, clip));
  if (to == "json") return json_of_contacts(clip, report, input, output);
  if (to == "fbx" || to == "glb") return write_with_curves(clip, to, curves_of(report, clip));
  return contacts_text(clip, report);
}

int run_contacts(const Arguments& arguments) {
  const std::string input = arguments.positionals.front();
  const std::string output = arguments.text("output"), to = arguments.text("to");
  const bool json = arguments.flag("json"), force = arguments.flag("force");
  const std::string map = arguments.text("map");
  RunFiles()
      .reads("IN", input)
      .reads("--map", map)
      .reads("--asf", arguments.text("asf"))
      .writes("--output", output)
      .check(json);
  if (output.empty() && (to == "fbx" || to == "glb"))
    throw Error(ErrorKind::usage, fmt::format("contacts: --to {} needs --output", to));
  if (!output.empty()) check_free(output, force);
  const TakeResult read = read_and_warn(input, read_options(arguments));
  const Take& clip = read.take;
  const FeetReport report = report_of(clip, names_of_map(map));
  if (report.sides.empty()) {
    say_warning(fmt::format("{}: no {} found; --map FILE gives the names of the feet",
                            input_name(input),
                            clip.has_joints() ? "legs" : "feet with markers on heel and toe"));
  }
  for (const std::string& warning : report.warnings)
    say_warning(fmt::format("{}: {}", input_name(input), warning));
  const std::string contents = contents_of(to, clip, report, input, output);
  if (!output.empty()) write_output(output, contents, force);
  if (json)
    write_out(json_of_contacts(clip, report, input, output));
  else if (output.empty())
    write_out(contents);
  return 0;
}

}  // namespace

Command contacts_command() {
  Command command;
  command.name = "contacts";
  command.summary = "list ground contacts of the feet, as a file to edit";
  command.description =
      "Finds the ground contacts of heels and toes and writes one a line: SIDE PART FIRST LAST, as "
      "in left heel 12 40, with frames as the file numbers them. # starts a comment: how likely "
      "the foot stands, 0 to 1. A slide that clean --feet auto would keep as intentional is "
      "written as a comment with the reason. Edit "
      "the file and give it to clean with --contacts, which holds every contact listed. Feet of "
      "markers need one on the heel and one on the toe, and are only listed.";
  command.positionals = {{"IN", "take; - is standard input", 1, 1, {}}};
  command.flags = {
      choice_flag("to", "Output", "what to write", {"text", "csv", "json", "fbx", "glb"}, "text",
                  "csv: contact_l and contact_r for each frame, 1 where the foot "
                  "stands. fbx, glb: the joints with these as curves, for an engine. "
                  "json: a report."),
      output_flag("where to write; default: standard output"), force_flag(),
      json_flag("print the contacts as JSON instead of text"), map_flag()};
  append(command.flags, reading_flags());
  command.examples = {
      {"kinemend contacts dance.bvh -o dance.contacts", "to look at and edit"},
      {"kinemend contacts gait.c3d", "when the feet of a marker set stand"},
      {"kinemend contacts rig.bvh --map names.csv -o rig.contacts",
       "names of feet that the program does not know"},
      {"kinemend contacts walk.bvh --to fbx -o walk_contacts.fbx",
       "curves contact_l and contact_r for motion matching and foot locking"},
      {"kinemend clean dance.bvh --contacts dance.contacts", "hold the listed contacts"}};
  command.run = run_contacts;
  return command;
}

}  // namespace kinemend::cli
