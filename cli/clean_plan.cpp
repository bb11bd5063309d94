#include "clean_plan.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "kinemend/io.hpp"
#include "method_options.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// `walk.bvh` to `walk.clean.bvh`, beside it or in another folder under its own name.
std::string output_of(const std::string& input, const std::string& folder) {
  const fs::path path(input);
  if (!folder.empty()) return (fs::path(folder) / path.filename()).string();
  const std::string extension = path.extension().string();
  fs::path output = path;
  output.replace_filename(path.stem().string() + ".clean" + extension);
  return output.string();
}

/// Standard input by any name: `-`, /dev/stdin, and what a shell passes as /dev/fd/63.
bool is_stream(const std::string& input) {
  if (input == "-") return true;
  const std::string name = fs::path(input).lexically_normal().string();
  return name.starts_with("/dev/") || name.starts_with("/proc/");
}

std::vector<CleanJob> make_jobs(const Arguments& arguments) {
  const std::vector<std::string>& inputs = arguments.positionals;
  const std::string output = arguments.text("output");
  const std::string folder = arguments.text("output_dir");
  if (!output.empty() && !folder.empty())
    throw Error(ErrorKind::usage, "clean: --output and --output-dir exclude each other");
  if (!output.empty() && inputs.size() > 1)
    throw Error(ErrorKind::usage, "clean: --output takes one input; for several, --output-dir");
  std::vector<CleanJob> jobs;
  std::map<std::string, std::string> taken;
  for (const std::string& input : inputs) {
    if (is_stream(input) && !folder.empty())
      throw Error(ErrorKind::usage, "clean: standard input has no name for --output-dir");
    std::string target = output;
    if (target.empty()) target = is_stream(input) ? "-" : output_of(input, folder);
    const auto [known, is_new] = taken.emplace(target, input);
    if (!is_new) {
      throw Error(ErrorKind::usage, fmt::format("clean: {} and {} would both be written to {}",
                                                known->second, input, target));
    }
    jobs.push_back({input, target, false});
  }
  return jobs;
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
  // --markers says --joints in the words of marker files.
  if (const auto markers = arguments.lists.find("markers"); markers != arguments.lists.end()) {
    std::vector<std::string>& names = settings.lists["joints"];
    names.insert(names.end(), markers->second.begin(), markers->second.end());
  }
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

/// A method that draws random numbers has an option for it.
void pass_seed(const Arguments& arguments, const Method& method, OptionValues& options) {
  for (const OptionSpec& spec : method.options) {
    if (spec.name == "seed") options["seed"] = arguments.whole("seed");
  }
}

/// What `--fill` and `--fill-all` ask for.
std::optional<FillSettings> fill_settings(const Settings& settings) {
  const std::string method = std::get<std::string>(settings.values.find("fill")->second);
  const bool fill_all = std::get<bool>(settings.values.find("fill_all")->second);
  if (method == "off" && !fill_all) return std::nullopt;
  FillSettings fill;
  fill.method = method == "off" ? "auto" : method;
  fill.fill_all = fill_all;
  return fill;
}

/// What `--feet` asks for.
std::optional<FeetSettings> feet_settings(const Settings& settings) {
  const std::string mode = std::get<std::string>(settings.values.find("feet")->second);
  if (mode == "off") return std::nullopt;
  FeetSettings feet;
  feet.mode = mode == "force" ? FeetMode::force : FeetMode::automatic;
  return feet;
}

CleanSettings clean_settings(const Settings& settings) {
  const auto list = [&](std::string_view name) {
    const auto found = settings.lists.find(name);
    return found == settings.lists.end() ? std::vector<std::string>() : found->second;
  };
  const auto number = [&](std::string_view name) {
    return std::get<double>(settings.values.find(name)->second);
  };
  CleanSettings result;
  result.strength = number("strength");
  result.max_change_deg = number("max_change_deg");
  if (const double most = number("max_change"); most > 0) result.max_change = most;
  result.peak_loss_limit = number("peak_loss_limit");
  result.fill = fill_settings(settings);
  result.feet = feet_settings(settings);
  result.root_position = std::get<bool>(settings.values.find("root_position")->second);
  result.joints = list("joints");
  result.exclude = list("exclude");
  return result;
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
  const OptionValues given = parse_method_options(method, arguments.group_texts);
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
  plan.settings = clean_settings(settings);
  if (const std::string range = arguments.text("range"); !range.empty())
    plan.range = parse_range(range);
  plan.strict = std::get<bool>(settings.values.find("strict")->second);
  plan.reading = read_options(arguments);
  plan.reading.strict = plan.strict;
  if (const std::string path = arguments.text("gaps"); !path.empty())
    plan.gaps = parse_gaps(read_file(path), input_name(path));
  plan.fix_swaps = std::get<bool>(settings.values.find("fix_swaps")->second);
  plan.force = arguments.flag("force");
  plan.threads = static_cast<int>(arguments.whole("jobs"));
  return plan;
}

CleanPlan make_clean_plan(const Arguments& arguments) {
  CleanPlan plan = make_cleaning(arguments);
  plan.jobs = make_jobs(arguments);
  if (const std::string path = arguments.text("contacts"); !path.empty()) {
    if (plan.jobs.size() > 1)
      throw Error(ErrorKind::usage, "clean: --contacts are of one take, not of several");
    plan.contacts.emplace(read_file(path), input_name(path));
    if (!plan.settings.feet) plan.settings.feet.emplace();
  }
  plan.folder = arguments.text("output_dir");
  plan.report_path = arguments.text("report");
  plan.dry_run = arguments.flag("dry_run");
  plan.json = arguments.flag("json");
  plan.verbose = arguments.flag("verbose");
  plan.quiet = arguments.flag("quiet");
  std::vector<std::string> outputs = {plan.report_path};
  std::vector<std::string> inputs = {arguments.text("config"), arguments.text("gaps"),
                                     arguments.text("contacts")};
  for (const CleanJob& job : plan.jobs) {
    inputs.push_back(job.input);
    if (!plan.dry_run) outputs.push_back(job.output);
  }
  check_single_use(inputs, outputs, plan.json);
  // What a dry run would write is not replaced by its report either.
  for (const CleanJob& job : plan.jobs) inputs.push_back(job.output);
  check_is_no_input("--report", plan.report_path, inputs);
  return plan;
}

}  // namespace kinemend::cli
