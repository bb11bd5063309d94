// kinemend corrupt: damages a take in a known way, for tests and comparisons.

#include "kinemend/lab/corrupt.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "command_line.hpp"
#include "commands.hpp"
#include "json.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

struct DamageRequest {
  std::string name;
  OptionValues values;
};

const Damage& damage_or_refuse(const std::string& name) {
  std::vector<std::string> names;
  for (const Damage& damage : damages()) {
    if (damage.name == name) return damage;
    names.push_back(damage.name);
  }
  const std::string guess = nearest_name(name, names);
  throw Error(
      ErrorKind::usage,
      guess.empty()
          ? fmt::format("--damage: unknown damage {}; known are {}", name, fmt::join(names, ", "))
          : fmt::format("--damage: unknown damage {} (did you mean {}?)", name, guess));
}

const OptionSpec& option_or_refuse(const Damage& damage, std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  std::vector<std::string> names;
  for (const OptionSpec& spec : damage.options) {
    if (spec.name == name) return spec;
    names.push_back(spec.name);
  }
  throw Error(ErrorKind::usage, fmt::format("--damage: {} has no option {}; it has {}", damage.name,
                                            name, fmt::join(names, ", ")));
}

bool is_switch_of(const Damage& damage, const std::string& name) {
  return std::any_of(damage.options.begin(), damage.options.end(), [&](const OptionSpec& spec) {
    return spec.name == name && std::holds_alternative<bool>(spec.default_value);
  });
}

/// Splits "a=1,b=x,y,c" into {a=1, b=x,y, c}: a part without = is a switch or continues the value
/// before it.
std::vector<std::string> split_options(const Damage& damage, const std::string& text) {
  std::vector<std::string> parts;
  for (const std::string& part : split_list({text})) {
    const bool goes_on = part.find('=') == std::string::npos && !is_switch_of(damage, part);
    if (goes_on && !parts.empty()) {
      parts.back() += "," + part;
    } else {
      parts.push_back(part);
    }
  }
  return parts;
}

/// "gaussian:std_deg=1.5,joints=Left*"
DamageRequest parse_damage(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const Damage& damage = damage_or_refuse(text.substr(0, colon));
  DamageRequest request{damage.name, {}};
  for (const std::string& part :
       split_options(damage, text.substr(std::min(colon + 1, text.size())))) {
    const std::size_t equals = part.find('=');
    const OptionSpec& spec = option_or_refuse(damage, part.substr(0, equals));
    if (equals == std::string::npos && !std::holds_alternative<bool>(spec.default_value))
      throw Error(ErrorKind::usage, fmt::format("--damage: {} needs a value", part));
    try {
      request.values[spec.name] =
          parse_option(spec, equals == std::string::npos ? "true" : part.substr(equals + 1));
    } catch (const Error& error) {
      throw Error(ErrorKind::usage, fmt::format("--damage {}: {}", damage.name, error.what()));
    }
  }
  return request;
}

Json json_of_damage(const DamageReport& report) {
  return {{"damage", report.kind},
          {"samples", report.samples},
          {"samples_damaged", report.samples_damaged},
          {"rms_deg", report.rms_deg},
          {"max_deg", report.max_deg},
          {"rms_position", report.rms_position},
          {"notes", report.notes}};
}

std::string text_of_damages(const std::vector<DamageReport>& reports) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right});
  table.add({"damage", "samples", "damaged", "rms deg", "max deg", "rms position"});
  std::string notes;
  for (const DamageReport& report : reports) {
    table.add({report.kind, grouped(report.samples), grouped(report.samples_damaged),
               figure(report.rms_deg), figure(report.max_deg), figure(report.rms_position)});
    for (const std::string& note : report.notes)
      notes += fmt::format("  {}: {}\n", report.kind, printable(note));
  }
  return table.text() + notes;
}

int run_corrupt(const Arguments& arguments) {
  const std::string input = arguments.positionals[0];
  const std::string output = arguments.text("output");
  const bool json = arguments.flag("json");
  const bool force = arguments.flag("force");
  if (output.empty())
    throw Error(ErrorKind::usage, "corrupt: --output is missing (see kinemend corrupt -h)");
  std::vector<DamageRequest> requests;
  for (const std::string& text : arguments.list("damage")) requests.push_back(parse_damage(text));
  if (requests.empty())
    throw Error(ErrorKind::usage, "corrupt: --damage is missing (see kinemend corrupt -h)");
  RunFiles()
      .reads("IN", input)
      .reads("--asf", arguments.text("asf"))
      .writes("--output", output, input)
      .check(json);
  check_take_ending(output);
  check_free(output, force);
  TakeResult read = read_and_warn(input, read_options(arguments));
  const std::string format = format_for(output, read.take.source);
  check_can_hold(input_name(input), read.take, format);
  Random random(static_cast<std::uint64_t>(arguments.whole("seed")));
  std::vector<DamageReport> reports;
  reports.reserve(requests.size());
  for (const DamageRequest& request : requests) {
    reports.push_back(apply_damage(read.take, request.name, request.values, random));
  }
  for (const std::string& line :
       loss_lines(input_name(input), read.take, format, arguments.flag("strict")))
    say_warning(line);
  write_take_output(output, read.take, format, force);
  if (json) {
    Json list = Json::array();
    for (const DamageReport& report : reports) list.push_back(json_of_damage(report));
    write_out(json_text({{"input", input},
                         {"output", output},
                         {"seed", arguments.whole("seed")},
                         {"damages", std::move(list)}}));
  } else if (arguments.flag("quiet")) {
    return 0;
  } else if (output == "-") {
    write_err(text_of_damages(reports));
  } else {
    write_out(text_of_damages(reports));
  }
  return 0;
}

}  // namespace

Command corrupt_command() {
  Flag damage = text_flag("damage", "NAME:OPTION=VALUE,...", "Work", "damage to apply",
                          "Repeat the option to apply several damages, in the order given.");
  damage.takes = Takes::repeated;
  Command command;
  command.name = "corrupt";
  command.summary = "damage a take in a known way, for tests";
  command.description =
      "Applies controlled damage and prints how many samples it changed and by how much. The same "
      "seed gives the same bytes on every machine. A calibration pose at the start is not "
      "changed.";
  command.positionals = {{"IN", "take to read; - is standard input", 1, 1, {}}};
  command.flags = {output_flag("where to write; - is standard output"),
                   force_flag(),
                   json_flag("print the summary as JSON instead of text"),
                   quiet_flag(),
                   damage,
                   seed_flag("seed of the random number generator")};
  append(command.flags, reading_flags("What the format cannot hold counts, too."));
  for (const Damage& entry : damages()) {
    command.groups.push_back({entry.name, entry.summary, entry.paper, entry.options});
    command.flags[4].spec.choices.push_back(entry.name);
  }
  command.group_heading = "Options of --damage %";
  command.examples = {
      {"kinemend corrupt walk.bvh -o noisy.bvh --damage gaussian:std_deg=1.5 --seed 7",
       "add jitter to every joint"}};
  command.run = run_corrupt;
  return command;
}

}  // namespace kinemend::cli
