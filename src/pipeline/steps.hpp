// The steps around the cleaner: what is selected, gaps that are filled after it, feet that are
// held.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/gap_plan.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Errors: `ErrorKind::usage` for a number or range that is out of range.
void check_settings(const CleanSettings& settings, std::size_t frames);

/// What the settings select: of joints the root position with joint 0, where it has channels; of
/// markers those that are positions. Errors: `ErrorKind::usage` for a pattern that matches nothing.
Selection selection_of(const Take& clip, const CleanSettings& settings);

/// 1 for each of `names` that `settings.joints` means and `settings.exclude` does not. `kind`
/// ("joint", "marker") stands in messages. Errors: `ErrorKind::usage` for a pattern that matches
/// nothing.
std::vector<std::uint8_t> select_names(const std::vector<std::string>& names,
                                       const CleanSettings& settings, std::string_view kind);

/// Fills the gaps of the selected joints or markers in the frames of weight above 0. `measured` is
/// the take before the cleaner, `cleaned` behind it, with what the cleaner says of it in `trace`;
/// the gaps are filled in `cleaned`, from its samples, so that they meet these. Where the cleaner
/// has left spikes, as `auto` finds them, they are filled from a take that was cleaned without
/// them. A gap that is refused stays as the cleaner has left it. The report lists the gaps of what
/// is selected.
FillReport fill_step(const Take& measured, const Cleaner& cleaner, const Selection& selection,
                     const std::vector<double>& weights, const FillSettings& settings,
                     const InPlaceTrace& trace, Take& cleaned, const FillCheck& check = {});

/// Holds feet in place as far as the selection lets legs and root move. `motion` begins with frame
/// `first` of the take, by whose frames settings and report go. What changed is stated in `trace`,
/// over what the cleaner did; filled and despiked samples stay such.
FeetReport feet_step(Take& motion, const Selection& selection, const FeetSettings& settings,
                     std::size_t first, InPlaceTrace& trace);

}  // namespace kinemend
