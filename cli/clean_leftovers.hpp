#pragma once

#include <string>
#include <vector>

#include "clean_plan.hpp"
#include "kinemend/check.hpp"
#include "kinemend/report.hpp"

namespace kinemend::cli {

/// What cleaning leaves as it is of what the check of a take finds, a line a kind. `input`: the
/// take's path.
std::vector<Leftover> leftovers_of(const std::vector<Finding>& findings, const CleanPlan& plan,
                                   const std::string& input);

}  // namespace kinemend::cli
