#include "clean/gap_step.hpp"

#include <algorithm>

#include "kinemend/cleaner.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

namespace {

std::unique_ptr<Cleaner> make_despiker() { return make_auto({.sensitivity = 0, .despike = true}); }

void despike(Clip& clip) { make_despiker()->clean(clip, Selection::all(clip)); }
void despike(MarkerClip& clip) { make_despiker()->clean_markers(clip, MarkerSelection::all(clip)); }

// Calls `take_over(i)` for the samples of `filled` that were missing and may be filled.
template <class TakeOver>
void for_each_filled(std::vector<std::uint8_t>& observed,
                     const std::vector<std::uint8_t>& filled_observed,
                     const std::vector<std::uint8_t>& selected, const std::vector<double>& weights,
                     const TakeOver& take_over) {
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const bool may_change = selected[i % selected.size()] != 0 && weights[i / selected.size()] > 0;
    if (observed[i] != 0 || filled_observed[i] == 0 || !may_change) continue;
    observed[i] = 1;
    take_over(i);
  }
}

// The same of the root position and the translations, which are selected with their joints.
void take_over_positions(Clip& clip, const Clip& filled, const std::vector<std::uint8_t>& selected,
                         const std::vector<double>& weights) {
  const std::size_t translated = clip.translated_joints.size();
  std::vector<std::uint8_t> tracks{selected[0]};
  for (const auto joint : clip.translated_joints)
    tracks.push_back(selected[static_cast<std::size_t>(joint)]);
  std::vector<std::uint8_t> all(clip.observed_positions.size(), 1);
  const auto& now = filled.observed_positions.empty() ? all : filled.observed_positions;
  for_each_filled(clip.observed_positions, now, tracks, weights, [&](std::size_t i) {
    const std::size_t frame = i / tracks.size(), track = i % tracks.size();
    if (track == 0) {
      clip.root_positions[frame] = filled.root_positions[frame];
    } else {
      const std::size_t at = frame * translated + track - 1;
      clip.joint_translations[at] = filled.joint_translations[at];
    }
  });
}

void drop_unselected(FillReport& report, const std::vector<std::uint8_t>& selected) {
  std::erase_if(report.gaps,
                [&](const GapOutcome& outcome) { return selected[outcome.gap.track] == 0; });
}

}  // namespace

FillReport fill_step(Clip& clip, const std::vector<std::uint8_t>& selected,
                     const std::vector<double>& weights, const FillSettings& settings) {
  if (clip.observed.empty() && clip.observed_positions.empty()) return {};
  Clip filled = clip;
  despike(filled);
  FillReport report = fill_gaps(filled, settings);
  drop_unselected(report, selected);
  if (filled.observed.empty()) filled.observed.assign(filled.local_rotations.size(), 1);
  for_each_filled(clip.observed, filled.observed, selected, weights,
                  [&](std::size_t i) { clip.local_rotations[i] = filled.local_rotations[i]; });
  take_over_positions(clip, filled, selected, weights);
  return report;
}

FillReport fill_step(MarkerClip& clip, const std::vector<std::uint8_t>& selected,
                     const std::vector<double>& weights, const FillSettings& settings) {
  if (find_gaps(clip).empty()) return {};
  MarkerClip filled = clip;
  despike(filled);
  FillReport report = fill_gaps(filled, settings);
  drop_unselected(report, selected);
  for_each_filled(clip.observed, filled.observed, selected, weights, [&](std::size_t i) {
    clip.positions[i] = filled.positions[i];
    if (!clip.residuals.empty()) clip.residuals[i] = 0;
  });
  return report;
}

}  // namespace kinemend
