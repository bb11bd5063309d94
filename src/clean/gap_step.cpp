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

void drop_unselected(FillReport& report, const std::vector<std::uint8_t>& selected) {
  std::erase_if(report.gaps,
                [&](const GapOutcome& outcome) { return selected[outcome.gap.track] == 0; });
}

}  // namespace

FillReport fill_step(Clip& clip, const std::vector<std::uint8_t>& selected,
                     const std::vector<double>& weights, const FillSettings& settings) {
  if (find_gaps(clip).empty()) return {};
  Clip filled = clip;
  despike(filled);
  FillReport report = fill_gaps(filled, settings);
  drop_unselected(report, selected);
  if (filled.observed.empty()) filled.observed.assign(filled.local_rotations.size(), 1);
  for_each_filled(clip.observed, filled.observed, selected, weights,
                  [&](std::size_t i) { clip.local_rotations[i] = filled.local_rotations[i]; });
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
