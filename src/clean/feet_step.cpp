// Holds feet within the selection and states which samples changed.
#include "clean/steps.hpp"

#include <algorithm>
#include <vector>

#include "feet/clean_legs.hpp"

namespace kinemend {

namespace {

// `changed`: F rows of `width`; the track is in column `column`.
void state_adjusted(const std::vector<std::uint8_t>& changed, std::size_t width, std::size_t column,
                    std::vector<Action>& actions) {
  if (changed.empty()) return;
  if (actions.empty()) actions.assign(changed.size() / width, Action::kept);
  for (std::size_t f = 0; f < actions.size(); ++f) {
    const bool is_repair = actions[f] == Action::filled || actions[f] == Action::despiked;
    if (changed[f * width + column] != 0 && !is_repair) actions[f] = Action::foot_adjusted;
  }
}

}  // namespace

FeetReport feet_step(Take& motion, const Selection& selection, const FeetSettings& settings,
                     std::size_t first, InPlaceTrace& trace) {
  FeetSettings own = settings;
  if (own.contacts) feet::shift_contacts(*own.contacts, first, 0);
  const bool is_noisy =
      std::any_of(trace.characters.begin(), trace.characters.end(),
                  [](const NoiseCharacter& noise) { return noise.space == Space::rotation; });
  const feet::FeetLimits limits{selection.owners, selection.root_position, selection.translations,
                                is_noisy};
  FeetReport report = feet::clean_legs(motion, own, limits);
  const std::size_t joints = motion.joint_count();
  for (std::size_t j = 0; j < joints; ++j)
    state_adjusted(report.changed, joints, j, trace.actions[j]);
  state_adjusted(report.root_changed, 1, 0, trace.actions[joints]);
  feet::shift_contacts(report.contacts, 0, first);
  report.changed.insert(report.changed.begin(), first * motion.joint_count(), 0);
  report.root_changed.insert(report.root_changed.begin(), first, 0);
  return report;
}

}  // namespace kinemend
