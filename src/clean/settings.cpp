// The table of the settings that are single values, the checks of all settings, and the tracks that
// the settings select.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include "base/options.hpp"
#include "clean/steps.hpp"
#include "kinemend/error.hpp"
#include "motion/names.hpp"

namespace kinemend {

namespace {

// The values as a command line or a file states them.
struct SingleValues {
  std::string source{to_string(CleanSettings{}.source)};
  double strength = CleanSettings{}.strength;
  double max_change_deg = CleanSettings{}.max_change_deg;
  double max_change = 0;
  std::string fill = "off";
  bool fill_all = FillSettings{}.fill_all;
  bool unlabelled = FillSettings{}.unlabelled;
  std::string feet = "by-source";
  bool fix_swaps = CleanSettings{}.fix_swaps;
  double peak_loss_limit = CleanSettings{}.peak_loss_limit;
  bool root_position = CleanSettings{}.root_position;
};

// A learned method needs a model, which no single value can name.
std::vector<std::string> fill_choices() {
  std::vector<std::string> names = {"off"};
  for (const FillMethod& method : fill_methods()) {
    if (!method.learned) names.emplace_back(method.name);
  }
  return names;
}

const OptionTable<SingleValues>& table() {
  using V = SingleValues;
  static const OptionTable<V> values =
      OptionTable<V>()
          .choice(&V::source, "source", source_names(), "what recorded the motion")
          .number(&V::strength, "strength", "", 0, 1,
                  "how far to go from the input (0) to the cleaned motion (1)")
          .number(&V::max_change_deg, "max_change_deg", "deg", 0, 180,
                  "largest change of a rotation, for joints")
          .number(&V::max_change, "max_change", "", 0, 1e12,
                  "largest change of a marker, in file units; 0: no limit")
          .choice(&V::fill, "fill", fill_choices(),
                  "fill gaps, from the cleaned motion around them")
          .flag(&V::fill_all, "fill_all", "fill every gap, also those that --fill refuses")
          .flag(&V::unlabelled, "unlabelled",
                "also fill unlabelled points (*52, U_12), and use them")
          .choice(&V::feet, "feet", {"by-source", "off", "auto", "force"},
                  "stop standing feet from sliding, as the last step; by-source: for sources with "
                  "slow errors (video, depth, suit)")
          .flag(&V::fix_swaps, "fix_swaps", "undo swapped marker labels first")
          .number(&V::peak_loss_limit, "peak_loss_limit", "", 0, 1,
                  "share of a peak speed that may be lost without a warning")
          .flag(&V::root_position, "root_position", "also clean the root's path");
  return values;
}

std::optional<FillSettings> fill_settings(const SingleValues& values) {
  if (values.fill == "off" && !values.fill_all) return std::nullopt;
  FillSettings fill;
  fill.method = values.fill == "off" ? "auto" : values.fill;
  fill.fill_all = values.fill_all;
  fill.unlabelled = values.unlabelled;
  return fill;
}

std::optional<FeetSettings> feet_settings(const SingleValues& values) {
  if (values.feet == "off") return std::nullopt;
  FeetSettings feet;
  feet.mode = values.feet == "force"  ? FeetMode::force
              : values.feet == "auto" ? FeetMode::automatic
                                      : FeetMode::by_source;
  return feet;
}

void check_number(std::string_view name, double value, double maximum) {
  if (value >= 0 && value <= maximum) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} is outside 0 to {}", name, value, maximum));
}

void check_noise(const KnownNoise& noise) {
  check_number("noise correlation", noise.correlation, 0.99);
  for (const auto& [name, strength] : noise.strengths) {
    if (!(strength > 0 && std::isfinite(strength)))
      throw Error(ErrorKind::usage,
                  fmt::format("noise of '{}': {} is not above 0", name, strength));
  }
}

}  // namespace

const std::vector<OptionSpec>& clean_options() { return table().specs(); }

const OptionSpec& clean_option(std::string_view name) {
  return find_option(clean_options(), name, "a clean");
}

CleanSettings clean_settings(const OptionValues& values) {
  // The message about an unknown source suggests a similar one.
  if (const auto given = values.find("source"); given != values.end()) {
    if (const auto* name = std::get_if<std::string>(&given->second)) parse_source(*name);
  }
  const SingleValues single = table().parse(values);
  CleanSettings settings;
  settings.source = parse_source(single.source);
  settings.strength = single.strength;
  settings.max_change_deg = single.max_change_deg;
  if (single.max_change > 0) settings.max_change = single.max_change;
  settings.fill = fill_settings(single);
  settings.feet = feet_settings(single);
  settings.fix_swaps = single.fix_swaps;
  settings.peak_loss_limit = single.peak_loss_limit;
  settings.root_position = single.root_position;
  return settings;
}

void check_settings(const CleanSettings& settings, std::size_t frames) {
  check_number("strength", settings.strength, clean_option("strength").maximum);
  check_number("max_change_deg", settings.max_change_deg, clean_option("max_change_deg").maximum);
  check_number("max_change", settings.max_change, std::numeric_limits<double>::infinity());
  check_number("peak_loss_limit", settings.peak_loss_limit,
               clean_option("peak_loss_limit").maximum);
  if (settings.noise) check_noise(*settings.noise);
  if (settings.fill && !settings.fill->names.empty())
    throw Error(ErrorKind::usage,
                "fill: what is filled is what may change; it has no names of its own");
  if (!settings.range) return;
  const auto [first, last] = *settings.range;
  if (first > last || last >= frames) {
    throw Error(ErrorKind::usage,
                fmt::format("range: frames {} to {} are not in a take of frames 0 to {}", first,
                            last, frames == 0 ? 0 : frames - 1));
  }
}

namespace {

TakeNoise noise_of(const std::vector<std::string>& names, const CleanSettings& settings) {
  TakeNoise noise;
  if (!settings.noise) return noise;
  noise.correlation = settings.noise->correlation;
  for (const std::string& name : names) {
    const auto known = settings.noise->strengths.find(name);
    noise.strengths.push_back(known == settings.noise->strengths.end() ? 0 : known->second);
  }
  return noise;
}

}  // namespace

Selection selection_of(const Take& take, const CleanSettings& settings) {
  Selection selection;
  const std::vector<std::string>& names = take.owner_names();
  selection.owners = select_names(names, settings, take.has_joints() ? "joint" : "marker");
  selection.noise = noise_of(names, settings);
  if (take.has_joints()) {
    selection.root_position = settings.root_position && selection.owners[0] != 0 &&
                              take.skeleton.has_position_channels(0);
    return selection;
  }
  for (std::size_t m = 0; m < take.marker_count(); ++m) {
    if (!take.holds_positions(m)) selection.owners[m] = 0;
  }
  selection.body_height = body_height(take);
  return selection;
}

std::vector<std::uint8_t> select_names(const std::vector<std::string>& names,
                                       const CleanSettings& settings, std::string_view kind) {
  std::vector<std::uint8_t> marks = names_meant(names, settings.joints, kind);
  if (settings.exclude.empty()) return marks;
  const std::vector<std::uint8_t> excluded = names_meant(names, settings.exclude, kind);
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = excluded[i] != 0 ? 0 : marks[i];
  return marks;
}

}  // namespace kinemend
