// Merges the settings of all sources, checks them, and plans the output of each take.
#include "clean_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "json.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"
#include "method_options.hpp"
#include "page_report.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

[[noreturn]] void fail_noise(const std::string& path, std::string_view reason) {
  throw Error(ErrorKind::usage, fmt::format("--noise {}: {}", path, reason));
}

// The noise entry for the take's own kind of tracks.
const Json& noise_of_tracks(const Json& take, const std::string& path) {
  const char* quantity = take.at("kind") == "markers" ? "position" : "rotation";
  for (const Json& noise : take.at("noise")) {
    if (noise.at("quantity") == quantity) return noise;
  }
  fail_noise(path, "the report found no noise in its take");
}

KnownNoise noise_of_report(const Json& report, const std::string& path) {
  if (!report.is_object() || report.value("schema", "") != report_schema)
    fail_noise(path, "expected white, auto, or a JSON report of clean or check");
  const Json& takes = report.at("takes");
  if (takes.empty() || !takes.front().contains("noise"))
    fail_noise(path, "the report has no noise in it; use a report of clean or check");
  const Json& take = takes.front();
  KnownNoise known;
  known.correlation = noise_of_tracks(take, path).at("correlation").get<double>();
  for (const Json& track : take.at("tracks")) {
    const double strength = track.value("noise", 0.0);
    if (strength > 0) known.strengths[track.at("name").get<std::string>()] = strength;
  }
  return known;
}

/// Returns the noise that `--noise` states: nullopt for "auto", white noise of measured strength
/// for "white", and otherwise the noise of the first take in the report at that path. Errors:
/// `ErrorKind::usage` for a file that is not a report of `clean` or `check` with noise; those of
/// `read_file`.
std::optional<KnownNoise> known_noise(const std::string& choice) {
  if (choice == "auto") return std::nullopt;
  if (choice == "white") return KnownNoise{};
  const std::string text = read_file(choice);
  try {
    return noise_of_report(parse_json<Json>(text), choice);
  } catch (const Json::exception&) {
    fail_noise(choice, "expected white, auto, or a JSON report of clean or check");
  }
}

/// Reads a file of gaps and checks its syntax; its frames are checked later against each take.
std::pair<std::string, std::string> read_gaps(const std::string& path) {
  constexpr std::int64_t any_frame = -(std::int64_t{1} << 53);
  std::pair<std::string, std::string> gaps(read_file(path), input_name(path));
  parse_gaps(gaps.first, gaps.second, any_frame);
  return gaps;
}

bool has_option(const Method& method, std::string_view name) {
  return std::any_of(method.options.begin(), method.options.end(),
                     [&](const OptionSpec& spec) { return spec.name == name; });
}

/// --map names the parts of a learned model and the feet of --feet. With a method that has no such
/// option, it concerns only the feet.
bool map_is_of_feet(const Arguments& arguments, const Settings& settings, const Method& method) {
  const std::string& feet = std::get<std::string>(settings.values.find("feet")->second);
  const bool has_feet = feet == "auto" || feet == "force" || arguments.given("contacts");
  return has_feet && !has_option(method, "map") && arguments.group_texts.count("map") > 0;
}

/// The file of --map, wherever it is given; empty if it is not.
std::string map_path(const Arguments& arguments, const OptionValues& options) {
  if (const auto given = arguments.group_texts.find("map"); given != arguments.group_texts.end())
    return given->second;
  const auto option = options.find("map");
  return option == options.end() ? std::string() : std::get<std::string>(option->second);
}

Settings command_line_settings(const Arguments& arguments) {
  Settings settings;
  for (const Flag& flag : arguments.command->flags) {
    if (!flag.configurable) continue;
    const std::string& name = flag.spec.name;
    if (const auto value = arguments.values.find(name); value != arguments.values.end())
      settings.values[name] = value->second;
    if (const auto list = arguments.lists.find(name); list != arguments.lists.end())
      settings.lists[name] = list->second;
  }
  // --markers is a synonym of --joints for marker files.
  if (std::vector<std::string> names = joints_of(arguments); !names.empty())
    settings.lists["joints"] = std::move(names);
  return settings;
}

OptionValues all_options(const Method& method, const Settings& settings) {
  OptionValues options;
  for (const OptionSpec& spec : method.options) options[spec.name] = spec.default_value;
  if (const auto set = settings.methods.find(method.name); set != settings.methods.end()) {
    for (const auto& [name, value] : set->second) options[name] = value;
  }
  return options;
}

/// Only a method that draws random numbers has a seed option.
void pass_seed(const Arguments& arguments, const Method& method, OptionValues& options) {
  for (const OptionSpec& spec : method.options) {
    if (spec.name == "seed") options["seed"] = arguments.whole("seed");
  }
}

CleanSettings settings_of(const Settings& settings) {
  OptionValues values;
  for (const OptionSpec& spec : clean_options())
    values[spec.name] = settings.values.find(spec.name)->second;
  CleanSettings result = clean_settings(values);
  const auto list = [&](std::string_view name) {
    const auto found = settings.lists.find(name);
    return found == settings.lists.end() ? std::vector<std::string>() : found->second;
  };
  result.joints = list("joints");
  result.exclude = list("exclude");
  return result;
}

/// A note for a preset that selects another method than the default. Empty if another setting
/// overrides its choice.
std::string preset_note(const Arguments& arguments, const Method& method) {
  const std::string name = arguments.text("preset");
  if (name.empty() || method.name == default_method || arguments.given("method")) return "";
  const Settings preset =
      parse_settings(*arguments.command, find_preset(name).text, "preset " + name);
  const auto chosen = preset.values.find("method");
  if (chosen == preset.values.end() || std::get<std::string>(chosen->second) != method.name)
    return "";
  return fmt::format("method {} is the choice of --preset {}, in place of {}, the default",
                     method.name, name, default_method);
}

}  // namespace

Settings merged_settings(const Arguments& arguments) {
  Settings settings;
  for (const Flag& flag : arguments.command->flags) {
    if (flag.configurable && flag.takes != Takes::list)
      settings.values[flag.spec.name] = flag.spec.default_value;
  }
  if (const std::string name = arguments.text("preset"); !name.empty()) {
    const Preset& preset = find_preset(name);
    put_over(settings, parse_settings(*arguments.command, preset.text, "preset " + name));
  }
  if (const std::string path = arguments.text("config"); !path.empty())
    put_over(settings, parse_settings(*arguments.command, read_file(path), input_name(path)));
  put_over(settings, command_line_settings(arguments));
  const Method& method = find_method(std::get<std::string>(settings.values.find("method")->second));
  auto texts = arguments.group_texts;
  if (map_is_of_feet(arguments, settings, method)) texts.erase("map");
  const OptionValues given = parse_method_options(method, texts);
  if (!given.empty()) put_over(settings, {{}, {}, {{method.name, given}}});
  return settings;
}

CleanPlan make_cleaning(const Arguments& arguments) {
  const Settings settings = merged_settings(arguments);
  CleanPlan plan;
  const Method& method = find_method(std::get<std::string>(settings.values.find("method")->second));
  plan.method = method.name;
  plan.options = all_options(method, settings);
  pass_seed(arguments, method, plan.options);
  plan.cleaner = make_cleaner(method.name, plan.options);
  plan.preset_note = preset_note(arguments, method);
  plan.settings = settings_of(settings);
  plan.settings.leftovers = Leftovers::all;
  plan.settings.noise = known_noise(arguments.text("noise"));
  if (arguments.given("contacts") && !plan.settings.feet) plan.settings.feet.emplace();
  if (plan.settings.feet)
    plan.settings.feet->names = names_of_map(map_path(arguments, plan.options));
  if (const std::string range = arguments.text("range"); !range.empty())
    plan.range = parse_range(range);
  plan.strict = std::get<bool>(settings.values.find("strict")->second);
  plan.reading = read_options(arguments);
  plan.reading.strict = plan.strict;
  if (const std::string path = arguments.text("gaps"); !path.empty()) plan.gaps = read_gaps(path);
  plan.force = arguments.flag("force");
  plan.threads = static_cast<int>(arguments.whole("jobs"));
  return plan;
}

RunFiles files_read(const CleanPlan& plan, const Arguments& arguments) {
  RunFiles files;
  for (const char* flag : {"config", "gaps", "asf"})
    files.reads(fmt::format("--{}", flag), arguments.text(flag));
  const std::string noise = arguments.text("noise");
  if (noise != "auto" && noise != "white") files.reads("--noise", noise);
  files.reads("--map", map_path(arguments, plan.options));
  for (const OptionSpec& spec : find_method(plan.method).options) {
    const auto value = plan.options.find(spec.name);
    if (value != plan.options.end() && names_file(spec))
      files.reads("--" + dashed(spec.name), std::get<std::string>(value->second));
  }
  return files;
}

namespace {

RunFiles files_of(const CleanPlan& plan, const Arguments& arguments) {
  RunFiles files = files_read(plan, arguments);
  files.reads("--contacts", arguments.text("contacts"));
  const char* const option = result_option(plan.takes);
  for (const TakeJob& job : plan.takes.jobs) {
    files.reads("IN", job.input);
    if (plan.dry_run)
      files.would_write(option, job.output);
    else
      files.writes(option, job.output, job.input);
  }
  plan.reports.add_to(files);
  return files;
}

}  // namespace

CleanPlan make_clean_plan(const Arguments& arguments) {
  CleanPlan plan = make_cleaning(arguments);
  plan.takes = plan_take_jobs(arguments, arguments.positionals, {"clean"});
  if (const std::string path = arguments.text("contacts"); !path.empty()) {
    if (plan.takes.jobs.size() > 1)
      throw Error(ErrorKind::usage, "clean: --contacts is for one take; clean several one by one");
    plan.contacts.emplace(read_file(path), input_name(path));
  }
  for (const Flag& flag : arguments.command->flags) {
    if (arguments.given(flag.spec.name)) plan.asked.push_back(flag.spec.name);
  }
  plan.reports = report_files(arguments, plan.takes.jobs.size());
  if (plan.reports.with_page()) plan.page = page_settings(arguments);
  plan.all_takes = arguments.flag("all_takes");
  if (plan.all_takes && (plan.page || arguments.given("take"))) {
    throw Error(ErrorKind::usage,
                "clean: --all-takes cannot be combined with --take, nor with a page of one take");
  }
  plan.dry_run = arguments.flag("dry_run");
  plan.json = arguments.flag("json");
  plan.verbose = arguments.flag("verbose");
  plan.quiet = arguments.flag("quiet");
  files_of(plan, arguments).check(plan.json);
  if (plan.takes.folder.empty()) check_take_ending(arguments.text("output"));
  return plan;
}

}  // namespace kinemend::cli
