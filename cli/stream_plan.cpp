// Selects methods that run live, and converts the flags of a live session to options.
#include "stream_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "kinemend/io.hpp"
#include "kinemend/methods.hpp"
#include "method_options.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

constexpr std::string_view default_live_method = "median";

std::string live_name(const LiveMethod& method) {
  std::string name = method.name;
  for (const auto& [option, value] : method.options)
    name += fmt::format(" --{}{}", std::get<bool>(value) ? "" : "no-", dashed(option));
  return name;
}

bool has_live_form(const Method& method) {
  return std::any_of(method.options.begin(), method.options.end(),
                     [](const OptionSpec& spec) { return spec.name == "live"; });
}

// Returns whether a method runs live by default, with an option, or with its model.
bool may_run_live(const Method& method) {
  static const std::vector<LiveMethod> list = live_methods();
  return has_live_form(method) || std::any_of(list.begin(), list.end(), [&](const LiveMethod& m) {
           return m.name == method.name;
         });
}

// Makes a learned method with a live form. Errors: those of the model.
std::unique_ptr<Cleaner> live_with_model(const Method& method, OptionValues values) {
  values.try_emplace("live", true);
  return make_cleaner(method.name, values);
}

Flag live_method_flag() {
  Flag method =
      text_flag("method", "NAME", "Cleaning", "how to clean: a method that runs live",
                "An option that a method needs to run live, such as --causal, is set for you.");
  method.spec.default_value = std::string(default_live_method);
  method.spec.choices = method_names();
  for (const Method& known : methods()) {
    if (may_run_live(known)) method.offered.push_back(known.name);
  }
  method.has_default = true;
  method.letter = 'm';
  return method;
}

Flag live_source_flag() {
  Flag flag = source_flag();
  flag.details =
      "video, depth and suit: slow noise is taken out, too. keyframed: only gaps are held. Frames "
      "of Axis Neuron come from a suit. For learned.";
  return flag;
}

}  // namespace

std::unique_ptr<Cleaner> live_cleaner(const Method& method, OptionValues values) {
  const std::vector<LiveMethod> list = live_methods();
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const LiveMethod& m) { return m.name == method.name; });
  bool runs = found != list.end();
  if (runs) {
    for (const auto& [option, value] : found->options)
      runs = values.try_emplace(option, value).first->second == value && runs;
  }
  if (runs) return make_cleaner(method.name, values);
  if (has_live_form(method)) return live_with_model(method, std::move(values));
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const LiveMethod& m : list) names.push_back(live_name(m));
  throw Error(ErrorKind::usage,
              fmt::format("stream: {} needs the whole take; methods that run live: {}", method.name,
                          fmt::join(names, ", ")));
}

std::vector<Flag> live_flags() {
  return {file_flag("skeleton", "FILE", "Input",
                    "BVH file with skeleton and frame rate, for a sender that sends no header"),
          without_default(number_flag("fps", "Hz", 0, 0.1, 100000, "Input",
                                      "frame rate; overrides that of the header")),
          switch_flag("numbered", "Input", "each line of values begins with its frame number",
                      "Lost, late and duplicate frames are recognised by it. Lost frames are "
                      "interpolated."),
          whole_flag("skip_words", 0, 0, 1000, "Input",
                     "words to skip at the start of each line of values"),
          number_flag("body_height", "", 1750, 1e-6, 1e9, "Input",
                      "markers: height of the person, in the units of the stream",
                      "Methods with settings in length scale them by it."),
          live_method_flag(),
          live_source_flag(),
          number_flag("strength", "", 1, 0, 1, "Cleaning",
                      "blend between the input (0) and the cleaned motion (1)"),
          switch_flag(
              "feet", "Cleaning", "hold feet that stand where they are",
              "For joints. It moves legs only, and adds no delay. Knees may move less smoothly."),
          choice_flag("format", "Output", "how to write cleaned frames", {"bvh", "jsonl"}, "bvh"),
          number_flag("longest_gap_s", "s", 1, 0, 3600, "Trouble",
                      "longest run of lost frames that is interpolated",
                      "The output then keeps its frame rate. A longer gap is a restart.")};
}

std::vector<OptionGroup> live_groups() {
  std::vector<OptionGroup> groups = method_groups();
  std::erase_if(groups,
                [](const OptionGroup& group) { return !may_run_live(find_method(group.name)); });
  return groups;
}

LiveOptions live_options(const Arguments& arguments) {
  LiveOptions options;
  options.format = arguments.text("format") == "jsonl" ? LiveFormat::jsonl : LiveFormat::bvh;
  options.strength = arguments.number("strength");
  options.frame_rate_hz = arguments.given("fps") ? arguments.number("fps") : 0;
  options.feet = arguments.flag("feet");
  options.source = parse_source(arguments.text("source"));
  options.numbered = arguments.flag("numbered");
  options.skipped_words = static_cast<std::size_t>(arguments.whole("skip_words"));
  options.body_height = arguments.number("body_height");
  options.longest_gap_s = arguments.number("longest_gap_s");
  if (const std::string path = arguments.text("skeleton"); !path.empty())
    options.skeleton = read_file(path);
  return options;
}

}  // namespace kinemend::cli
