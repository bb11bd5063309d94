// kinemend check: finds the faults of a take before it is cleaned.

#include "kinemend/check.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "batch_list.hpp"
#include "commands.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"
#include "page_report.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

// Reads the limits of a robot, with line numbers for errors.
class LimitsReader {
 public:
  explicit LimitsReader(std::string_view name) : name_(name) {}

  RobotSettings read(const toml::table& root) const {
    RobotSettings settings;
    settings.limits = limits_in(root, settings.limits, {"joints"});
    const toml::node* joints = root.get("joints");
    if (joints == nullptr) return settings;
    if (!joints->is_table()) refuse(*joints, "joints: is not a table of patterns");
    for (const auto& [pattern, node] : in_order_of_lines(*joints->as_table()))
      settings.joints.push_back({pattern, joint_limits(pattern, *node, settings.limits)});
    return settings;
  }

 private:
  // toml++ sorts tables by name, but the file's order decides which pattern applies.
  static std::vector<std::pair<std::string, const toml::node*>> in_order_of_lines(
      const toml::table& table) {
    std::vector<std::pair<std::string, const toml::node*>> nodes;
    for (const auto& [key, node] : table) nodes.emplace_back(std::string(key.str()), &node);
    std::stable_sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) {
      return a.second->source().begin.line < b.second->source().begin.line;
    });
    return nodes;
  }

  JointLimits joint_limits(const std::string& pattern, const toml::node& node,
                           JointLimits inherited) const {
    if (!node.is_table()) refuse(node, pattern + ": is not a table of limits");
    return limits_in(*node.as_table(), inherited, {});
  }

  JointLimits limits_in(const toml::table& table, JointLimits limits,
                        const std::vector<std::string>& others) const {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (name == "speed_deg_s")
        limits.speed_deg_s = positive(name, node);
      else if (name == "acceleration_deg_s2")
        limits.acceleration_deg_s2 = positive(name, node);
      else if (std::find(others.begin(), others.end(), name) == others.end())
        refuse_unknown(name, node, others);
    }
    return limits;
  }

  double positive(const std::string& name, const toml::node& node) const {
    constexpr double most = 1e9;
    const auto value = node.value<double>();
    if (node.is_number() && value && *value > 0 && *value <= most) return *value;
    refuse(node, name + ": is not a number above 0, up to 1e9");
  }

  [[noreturn]] void refuse_unknown(const std::string& key, const toml::node& node,
                                   const std::vector<std::string>& others) const {
    std::vector<std::string> known = {"speed_deg_s", "acceleration_deg_s2"};
    known.insert(known.end(), others.begin(), others.end());
    const std::string guess = nearest_name(key, known);
    refuse(node, fmt::format("unknown limit {}{}", key,
                             guess.empty() ? "" : fmt::format(" (did you mean {}?)", guess)));
  }

  [[noreturn]] void refuse(const toml::node& node, const std::string& message) const {
    throw Error(ErrorKind::usage,
                fmt::format("{}:{}: {}", name_, node.source().begin.line, message));
  }

  std::string_view name_;
};

/// Returns the settings of --robot. `path` is the file of --limits, a TOML text, or empty.
/// `speed_deg_s` and `acceleration_deg_s2` apply to all joints; a table `[joints."PATTERN"]` with
/// either applies to joints whose names match, and inherits the other. Later tables override
/// earlier ones. Errors, with the line: `ErrorKind::unreadable_input` for text that is not TOML,
/// `ErrorKind::usage` for an unknown key or a value that is not above 0; those of reading the file.
RobotSettings robot_settings(const std::string& path) {
  if (path.empty()) return {};
  const std::string text = read_file(path), name = input_name(path);
  try {
    return LimitsReader(name).read(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
  }
}

// Returns whether --robot or one of its options is given.
bool wants_robot(const Arguments& arguments) {
  const std::span<const FigureRule> figures = check_figures();
  return arguments.flag("robot") || arguments.given("limits") ||
         std::any_of(figures.begin(), figures.end(), [&](const FigureRule& figure) {
           return figure.of_robot && arguments.given(std::string(figure.limit));
         });
}

CheckSettings check_settings(const Arguments& arguments) {
  CheckSettings settings;
  if (arguments.given("up")) settings.up = axis_named(arguments.text("up"));
  if (arguments.given("metres_per_unit"))
    settings.metres_per_unit = arguments.number("metres_per_unit");
  settings.names = names_of_map(arguments.text("map"));
  settings.source = parse_source(arguments.text("source"));
  if (wants_robot(arguments)) settings.robot = robot_settings(arguments.text("limits"));
  return settings;
}

struct Checked {
  Take take;
  Report report;
};

Checked check_file(const std::string& input, const Arguments& arguments) {
  TakeResult read = read_take(std::filesystem::path(input), read_options(arguments));
  CheckSettings settings = check_settings(arguments);
  settings.plates = force_plates(read.take);
  CheckReport report = check_take(read.take, settings);
  TakeFacts facts = facts_of(read.take, input, std::move(read.diagnostics));
  return {std::move(read.take), {std::move(facts), std::move(report)}};
}

/// The files given, and the takes below the folders given.
std::vector<std::string> takes_to_check(const Arguments& arguments) {
  std::vector<std::string> takes = takes_below(arguments.positionals);
  if (!takes.empty()) return takes;
  throw Error(ErrorKind::unreadable_input,
              fmt::format("{}: holds no take", arguments.positionals.front()));
}

/// Prints the command that cleans the takes of a checked folder.
void say_how_to_clean(const Arguments& arguments) {
  for (const std::string& input : arguments.positionals) {
    std::error_code ignored;
    if (std::filesystem::is_directory(input, ignored))
      say(fmt::format("to clean the takes in {0} use: kinemend batch {0} -o OUT", input));
  }
}

ReportFiles checked_outputs(const Arguments& arguments, const std::vector<std::string>& inputs) {
  const std::string gaps_out = arguments.text("gaps_out");
  const bool force = arguments.flag("force");
  ReportFiles reports = report_files(arguments, inputs.size());
  if (!gaps_out.empty() && inputs.size() > 1)
    throw Error(ErrorKind::usage, "--gaps-out: needs a single take");
  RunFiles files;
  files.reads("FILE", inputs)
      .reads("--map", arguments.text("map"))
      .reads("--asf", arguments.text("asf"))
      .reads("--limits", arguments.text("limits"))
      .writes("--gaps-out", gaps_out);
  reports.add_to(files);
  files.check(arguments.flag("json"));
  if (!gaps_out.empty()) check_free(gaps_out, force);
  reports.check_free(force);
  return reports;
}

int run_check(const Arguments& arguments) {
  const bool json = arguments.flag("json"), force = arguments.flag("force");
  const bool quiet = arguments.flag("quiet");
  const std::string gaps_out = arguments.text("gaps_out");
  const std::vector<std::string> inputs = takes_to_check(arguments);
  const ReportFiles reports = checked_outputs(arguments, inputs);
  TextOptions options;
  options.all = arguments.flag("verbose");
  options.colours = Colours::of_out().on();
  std::vector<std::string> takes;
  std::string page;
  const auto visit = [&](const std::string& input) {
    const auto [take, report] = check_file(input, arguments);
    if (!gaps_out.empty()) {
      const auto& stale = std::get<CheckReport>(report.result).stale;
      write_output(gaps_out, gaps_text(stale, report.take.first_frame), force);
    }
    if (reports.with_page()) page = report_page(report, take, nullptr, page_settings(arguments));
    if (json || reports.with_json()) takes.push_back(to_json(report));
    if (!json && !quiet && gaps_out != "-" && !reports.on_out()) {
      write_out(to_text(report, options));
    }
    return say_passed_limits(report, check_figures(), arguments);
  };
  std::size_t failed = 0;
  const int code = for_each_input(inputs, visit, [&](std::string entry) {
    takes.push_back(std::move(entry));
    ++failed;
  });
  const std::string document = report_document("check", takes);
  // If every input fails, no report is written.
  if (failed < inputs.size()) reports.write(document, page, force);
  if (json) write_out(document);
  if (!json && !quiet) say_how_to_clean(arguments);
  return code;
}

Flag of_checks(Flag flag) {
  flag.group = "Checks";
  flag.details = "The noise and the spikes listed are those that clean removes with this --source.";
  return flag;
}

std::vector<Flag> robot_flags() {
  Flag limits = file_flag("limits", "FILE", "Checks", "limits of joints for --robot, in TOML",
                          "speed_deg_s and acceleration_deg_s2 for all joints, and tables such as "
                          "[joints.\"*Knee\"] for joints by name. Implies --robot.");
  return {
      switch_flag("robot", "Checks", "also check what a robot or a simulated body cannot follow",
                  "Joints that are too fast, jumps, feet in or above the floor, and times in "
                  "the air. The JSON also lists when heels and toes stand."),
      std::move(limits)};
}

std::vector<Flag> check_flags() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Flag gaps_out = file_flag(
      "gaps_out", "FILE", "Output", "write frozen and bridged spans as a side file of gaps",
      "Give it to kinemend fill or clean with --gaps to fill these spans again.");
  std::vector<Flag> list = {
      json_flag("print JSON instead of text"),
      verbose_flag("list every finding and every track"),
      quiet_flag("Limits that are exceeded are errors."),
      gaps_out,
      reports_flag("also write what was found: FILE.json, or FILE.html as a page for a browser",
                   "A page shows one take, with its motion."),
      force_flag(),
      choice_flag("up", "Checks", "vertical axis, if it cannot be found from the body",
                  {"x", "y", "z"}),
      without_default(number_flag("metres_per_unit", "m", 0, 1e-9, 1e6, "Checks",
                                  "length of a file unit, if the take does not state it")),
  };
  append(list, robot_flags());
  list.push_back(of_checks(source_flag()));
  list.push_back(map_flag());
  append(list, reading_flags());
  for (const FigureRule& entry : check_figures()) {
    list.push_back(without_default(
        number_flag(std::string(entry.limit), std::string(entry.unit), 0, 0, infinity, "Limits",
                    fmt::format("limit; exit code 1 above it: {}", entry.label))));
  }
  return list;
}

}  // namespace

Command check_command() {
  Command command;
  command.name = "check";
  command.summary = "say what is wrong with a take";
  command.description =
      "Lists what is wrong with a take, worst first: gaps, spikes, frozen and bridged spans, noise "
      "of each joint or marker, swapped markers, lengths that change, feet that slide or sink, a "
      "rate or a unit that looks wrong, jumps of Euler angles, and frames that repeat or are all "
      "zero. The take is not changed.\n\n"
      "Each --max option sets a limit. If a figure exceeds one, the exit code is 1 and the worst "
      "finding is printed. A figure that the take does not have (the slide, without ground "
      "contact) exceeds no limit. --map gives the names of feet that the program does not know. In "
      "a file with several people (Ann:LTOE, Bob:LTOE) each person is checked separately.";
  command.positionals = {
      {"FILE", "take, or folder with takes, to check; - is standard input", 1, 1000000, {}}};
  command.flags = check_flags();
  command.examples = {
      {"kinemend check walk.c3d", "what is wrong with it"},
      {"kinemend check raw", "every take in a folder and below it"},
      {"kinemend check *.bvh --max-spikes 0 --max-gap-s 0.2", "as a check in a script"},
      {"kinemend check walk.bvh --gaps-out gaps.csv", "frozen and bridged spans as a side file"},
      {"kinemend check walk.bvh --robot --max-jumps 0", "before a robot learns from it"}};
  command.run = run_check;
  return command;
}

}  // namespace kinemend::cli
