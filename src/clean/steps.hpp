// The steps around the cleaner: the selection, the filling of gaps, the holding of feet, and the
// faults that are left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Throws `ErrorKind::usage` for a number or range that is out of range.
void check_settings(const CleanSettings& settings, std::size_t frames);

/// Returns the tracks that the settings select. Joint 0 includes the root position if it has
/// channels; only markers that are positions are selected. Throws `ErrorKind::usage` for a pattern
/// that matches nothing.
Selection selection_of(const Take& clip, const CleanSettings& settings);

/// Returns 1 for each of `names` that `settings.joints` matches and `settings.exclude` does not.
/// `kind` ("joint", "marker") is used in messages. Throws `ErrorKind::usage` for a pattern that
/// matches nothing.
std::vector<std::uint8_t> select_names(const std::vector<std::string>& names,
                                       const CleanSettings& settings, std::string_view kind);

/// Fills the gaps of the selected joints or markers in the frames of weight above 0. `measured` is
/// the take before the cleaner, `cleaned` after it, `trace` the cleaner's statements. Gaps are
/// filled in `cleaned`, from its samples, so that fillings meet these. If the cleaner has left
/// spikes (as `auto` finds them), gaps are filled from a take that was cleaned without them. A
/// refused gap stays as the cleaner left it. The report lists the gaps of the selection.
FillReport fill_step(const Take& measured, const Cleaner& cleaner, const Selection& selection,
                     const std::vector<double>& weights, const FillSettings& settings,
                     const InPlaceTrace& trace, Take& cleaned, const FillCheck& check = {});

/// Holds feet in place as far as the selection lets legs and root move. `motion` begins with frame
/// `first` of the take, whose frame numbers settings and report use. Changes are stated in `trace`,
/// over those of the cleaner; filled and despiked samples keep their action.
FeetReport feet_step(Take& motion, const Selection& selection, const FeetSettings& settings,
                     std::size_t first, InPlaceTrace& trace);

/// Returns the faults of the input that cleaning does not mend, one line per kind; empty if the
/// settings ask for none.
std::vector<Leftover> leftovers_beyond_cleaning(const Take& input, const CleanSettings& settings);

/// If nothing changed in the take and the settings ask for all leftovers, adds its other faults to
/// the report, one line per kind: the finding, the reason and the advice.
void explain_unchanged(const Take& result, const CleanSettings& settings, CleanReport& report);

}  // namespace kinemend
