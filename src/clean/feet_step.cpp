#include "clean/feet_step.hpp"

#include <vector>

#include "feet/clean_legs.hpp"

namespace kinemend {

namespace {

void state_adjusted(const std::vector<std::uint8_t>& changed, std::vector<Action>& actions) {
  if (actions.empty()) actions.assign(changed.size(), Action::kept);
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const bool is_repair = actions[i] == Action::filled || actions[i] == Action::despiked;
    if (changed[i] != 0 && !is_repair) actions[i] = Action::foot_adjusted;
  }
}

}  // namespace

FeetReport feet_step(Clip& motion, const Selection& selection, const FeetSettings& settings,
                     std::size_t first, CleanTrace& trace) {
  FeetSettings own = settings;
  if (own.contacts) feet::shift_contacts(*own.contacts, first, 0);
  const feet::FeetLimits limits{selection.joints, selection.root_position, selection.translations};
  FeetReport report = feet::clean_legs(motion, own, limits);
  state_adjusted(report.changed, trace.actions);
  state_adjusted(report.root_changed, trace.root_actions);
  feet::shift_contacts(report.contacts, 0, first);
  report.changed.insert(report.changed.begin(), first * motion.joint_count(), 0);
  report.root_changed.insert(report.root_changed.begin(), first, 0);
  return report;
}

}  // namespace kinemend
