// kinemend contacts: writes the times when feet stand, as a file to edit.

#include <fmt/format.h>

#include <vector>

#include "commands.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

Take take_of_joints(const std::string& input, const ReadOptions& options) {
  TakeResult read = read_and_warn(input, options);
  if (read.take.has_joints()) return std::move(read.take);
  throw Error(
      ErrorKind::usage,
      fmt::format("{}: this take holds markers; ground contacts are found in takes of joints",
                  input_name(input)));
}

int run_contacts(const Arguments& arguments) {
  const std::string input = arguments.positionals.front();
  std::string output = arguments.text("output");
  const bool json = arguments.flag("json"), force = arguments.flag("force");
  const std::string map = arguments.text("map");
  RunFiles()
      .reads("IN", input)
      .reads("--map", map)
      .reads("--asf", arguments.text("asf"))
      .writes("--output", output)
      .check(json);
  if (!output.empty()) check_free(output, force);
  const Take clip = take_of_joints(input, read_options(arguments));
  Take copy = clip;
  FeetSettings settings;
  settings.names = names_of_map(map);
  const FeetReport report = clean_feet(copy, settings);
  if (report.sides.empty()) {
    say_warning(fmt::format("{}: no legs found; --map FILE gives the names of the feet",
                            input_name(input)));
  }
  for (const std::string& warning : report.warnings)
    say_warning(fmt::format("{}: {}", input_name(input), warning));
  const std::string text = contacts_text(clip, report);
  if (!output.empty()) write_output(output, text, force);
  if (json) {
    Report about{take_facts(clip), report};
    about.take.input = input;
    about.take.output = output;
    const std::vector<std::string> takes = {to_json(about)};
    write_out(report_document("contacts", takes));
  } else if (output.empty()) {
    write_out(text);
  }
  return 0;
}

}  // namespace

Command contacts_command() {
  Command command;
  command.name = "contacts";
  command.summary = "list ground contacts of the feet, as a file to edit";
  command.description =
      "Finds the ground contacts of heels and toes and writes one a line: SIDE PART FIRST LAST, as "
      "in left heel 12 40, with frames as the file numbers them. # starts a comment. A slide that "
      "clean --feet auto would keep as intentional is written as a comment with the reason. Edit "
      "the file and give it to clean with --contacts, which holds every contact listed.";
  command.positionals = {{"IN", "take of joints; - is standard input", 1, 1, {}}};
  command.flags = {output_flag("where to write; default: standard output"), force_flag(),
                   json_flag("print the contacts as JSON instead of text"), map_flag()};
  append(command.flags, reading_flags());
  command.examples = {
      {"kinemend contacts dance.bvh -o dance.contacts", "to look at and edit"},
      {"kinemend contacts rig.bvh --map names.csv -o rig.contacts",
       "names of feet that the program does not know"},
      {"kinemend clean dance.bvh --contacts dance.contacts", "hold the listed contacts"}};
  command.run = run_contacts;
  return command;
}

}  // namespace kinemend::cli
