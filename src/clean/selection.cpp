// Matches the patterns of the settings with the names of a take.
#include "clean/steps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "kinemend/error.hpp"
#include "motion/name_pattern.hpp"

namespace kinemend {

namespace {

void check_number(const char* name, double value, double maximum) {
  if (value >= 0 && value <= maximum) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} is outside 0 to {}", name, value, maximum));
}

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

void check_noise(const KnownNoise& noise) {
  check_number("noise correlation", noise.correlation, 0.99);
  for (const auto& [name, strength] : noise.strengths) {
    if (!(strength > 0 && std::isfinite(strength)))
      throw Error(ErrorKind::usage,
                  fmt::format("noise of '{}': {} is not above 0", name, strength));
  }
}

}  // namespace

void check_settings(const CleanSettings& settings, std::size_t frames) {
  check_number("strength", settings.strength, 1);
  check_number("max_change_deg", settings.max_change_deg, 180);
  check_number("max_change", settings.max_change, std::numeric_limits<double>::infinity());
  check_number("peak_loss_limit", settings.peak_loss_limit, 1);
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
