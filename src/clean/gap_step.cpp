// Fills gaps from the cleaned take, or from one without spikes where the cleaner left some.
#include "clean/steps.hpp"

#include <algorithm>
#include <memory>
#include <utility>

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

}  // namespace kinemend
