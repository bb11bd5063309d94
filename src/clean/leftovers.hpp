// Lists the faults that cleaning left in a take, each with its reason and advice.
#pragma once

#include <vector>

#include "kinemend/clean.hpp"

namespace kinemend {

/// Returns the faults of the input that cleaning does not mend, one line per kind; empty if the
/// settings ask for none.
std::vector<Leftover> leftovers_beyond_cleaning(const Take& input, const CleanSettings& settings);

/// If nothing changed in the take and the settings ask for all leftovers, adds its other faults to
/// the report, one line per kind: the finding, the reason and the advice.
void explain_unchanged(const Take& result, const CleanSettings& settings, CleanReport& report);

}  // namespace kinemend
