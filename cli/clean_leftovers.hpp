// Explains the faults that cleaning cannot repair, the noise that it left, and flags without
// effect.
#pragma once

#include <string>
#include <vector>

#include "clean_plan.hpp"
#include "kinemend/check.hpp"
#include "kinemend/report.hpp"

namespace kinemend::cli {

/// The findings of a check that cleaning does not repair, one line per kind. `input` is the path of
/// the take.
std::vector<Leftover> leftovers_of(const std::vector<Finding>& findings, const CleanPlan& plan,
                                   const std::string& input);
/// The faults of a take that cleaning left unchanged, one line per kind: the finding, the reason
/// and the advice. Kinds reported by `leftovers_of` are omitted. Empty if there are no faults.
std::vector<Leftover> reasons_unchanged(const Take& take, const CleanReport& report,
                                        const CleanPlan& plan, const std::string& input);
/// Flags of the command line that have no effect on a take of this kind, one line each.
std::vector<std::string> meaningless_flags(const Take& take, const CleanPlan& plan);

}  // namespace kinemend::cli
