// Matches the patterns of the settings with the names of a take.
#include "clean/steps.hpp"

#include "motion/name_pattern.hpp"

namespace kinemend {

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
