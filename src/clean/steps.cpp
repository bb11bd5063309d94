// Fills gaps from the cleaned take, or from one without spikes where the cleaner left some. Holds
// feet within the selection, and states which samples changed.
#include "clean/steps.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "feet/clean_legs.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

namespace {

std::unique_ptr<Cleaner> make_despiker() { return make_auto({.sensitivity = 0, .despike = true}); }

bool holds_more_spikes(const InPlaceTrace& found, const InPlaceTrace& repaired) {
  for (std::size_t n = 0; n < found.actions.size(); ++n) {
    for (std::size_t f = 0; f < found.actions[n].size(); ++f) {
      if (found.actions[n][f] != Action::despiked) continue;
      if (repaired.actions[n].empty() || repaired.actions[n][f] != Action::despiked) return true;
    }
  }
  return false;
}

// Returns the samples that gaps are filled from: the cleaned take, or one cleaned without its
// spikes.
Take evidence_of(const Take& measured, const Cleaner& cleaner, const Selection& selection,
                 const InPlaceTrace& trace, const Take& cleaned) {
  Take evidence = measured;
  if (holds_more_spikes(clean_in_place(*make_despiker(), evidence), trace))
    clean_in_place(cleaner, evidence, selection);
  else
    evidence = cleaned;
  evidence.observed = measured.observed;
  evidence.observed_positions = measured.observed_positions;
  return evidence;
}

// Calls `take_over(i)` for the selected samples that were missing, are filled, and have weight.
template <class TakeOver>
void for_each_filled(const std::vector<std::uint8_t>& measured,
                     const std::vector<std::uint8_t>& filled,
                     const std::vector<std::uint8_t>& selected, const std::vector<double>& weights,
                     const TakeOver& take_over) {
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const bool may_change = selected[i % selected.size()] != 0 && weights[i / selected.size()] > 0;
    if (measured[i] == 0 && filled[i] != 0 && may_change) take_over(i);
  }
}

// Takes over the root position and the translations, which are selected with their joints.
void take_over_positions(const Take& measured, const Take& filled,
                         const std::vector<std::uint8_t>& selected,
                         const std::vector<double>& weights, Take& clip) {
  std::vector<std::uint8_t> tracks{selected[0]};
  for (const auto joint : clip.translated_joints)
    tracks.push_back(selected[static_cast<std::size_t>(joint)]);
  const auto take_over = [&](std::size_t i) {
    clip.observed_positions[i] = 1;
    clip.positions[i] = filled.positions[i];
  };
  for_each_filled(measured.observed_positions, filled.observed_positions, tracks, weights,
                  take_over);
}

void drop_unselected(FillReport& report, const std::vector<std::uint8_t>& selected) {
  std::erase_if(report.gaps,
                [&](const GapOutcome& outcome) { return selected[outcome.gap.track] == 0; });
}

}  // namespace

FillReport fill_step(const Take& measured, const Cleaner& cleaner, const Selection& selection,
                     const std::vector<double>& weights, const FillSettings& settings,
                     const InPlaceTrace& trace, Take& cleaned, const FillCheck& check) {
  const bool joints = measured.has_joints();
  if (find_gaps(measured).empty() && find_position_gaps(measured).empty()) return {};
  Take filled = evidence_of(measured, cleaner, selection, trace, cleaned);
  FillReport report = fill_with_plan(filled, settings, check).report;
  drop_unselected(report, selection.owners);
  for_each_filled(measured.observed, filled.observed, selection.owners, weights,
                  [&](std::size_t i) {
                    if (joints)
                      cleaned.rotations[i] = filled.rotations[i];
                    else
                      cleaned.positions[i] = filled.positions[i];
                    cleaned.observed[i] = 1;
                    if (!cleaned.residuals.empty()) cleaned.residuals[i] = 0;
                  });
  if (joints) take_over_positions(measured, filled, selection.owners, weights, cleaned);
  return report;
}

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

bool has_noise_of(const CleanTrace& trace, Space space) {
  return std::any_of(trace.characters.begin(), trace.characters.end(),
                     [&](const NoiseCharacter& noise) { return noise.space == space; });
}

// Returns the error of the joints after cleaning in radians per axis: what the method expects to be
// left, else the noise that it measured; 0 if there is hardly any.
double error_of_joints(const InPlaceTrace& trace, std::size_t joints) {
  constexpr double least_deg = 0.2;  // less moves a foot by less than a rolling one moves
  std::vector<double> left;
  for (std::size_t j = 0; j < std::min(joints, trace.left.size()); ++j) {
    if (trace.left[j] > 0) left.push_back(trace.left[j]);
  }
  double error_deg = left.empty() ? 0 : median_of(left);
  for (const NoiseCharacter& noise : trace.characters) {
    if (left.empty() && noise.space == Space::rotation) error_deg = noise.strength;
  }
  return error_deg > least_deg ? radians_per_degree * error_deg : 0;
}

}  // namespace

FeetReport feet_step(Take& motion, const Selection& selection, const FeetSettings& settings,
                     std::size_t first, InPlaceTrace& trace) {
  FeetSettings own = settings;
  if (own.contacts) feet::shift_contacts(*own.contacts, first, 0);
  const double error = error_of_joints(trace, motion.joint_count());
  const bool is_slow = expects_slow_noise(selection.source) && error > 0;
  const feet::FeetLimits limits{selection.owners,
                                selection.root_position,
                                selection.translations,
                                has_noise_of(trace, Space::rotation) || is_slow,
                                error,
                                has_noise_of(trace, Space::position) || is_slow,
                                is_slow};
  // Thresholds suffice for a take without noise, and a model would only shift the ends of stands.
  if (error == 0) own.contact.finder = ContactFinder::thresholds;
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
