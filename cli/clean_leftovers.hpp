// Explains what cleaning left in a take: faults that it does not repair, noise that it kept, and
// flags without effect.
#pragma once

#include <string>
#include <vector>

#include "clean_plan.hpp"
#include "kinemend/check.hpp"
#include "kinemend/report.hpp"

namespace kinemend::cli {

/// The findings of a check that cleaning does not mend, a line for each kind. `input`: the take's
/// path.
std::vector<Leftover> leftovers_of(const std::vector<Finding>& findings, const CleanPlan& plan,
                                   const std::string& input);
/// What is wrong with a take that cleaning left unchanged, a line for each kind: what was found,
/// why it was left and what to try. Empty where nothing is wrong. Kinds that `leftovers_of` tells
/// of are left out.
std::vector<Leftover> reasons_unchanged(const Take& take, const CleanReport& report,
                                        const CleanPlan& plan, const std::string& input);
/// Flags of the command line that mean nothing for a take of this kind, a line for each.
std::vector<std::string> meaningless_flags(const Take& take, const CleanPlan& plan);

}  // namespace kinemend::cli
