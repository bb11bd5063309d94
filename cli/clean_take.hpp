// Cleans one take of a plan and returns only text, so that a batch does not grow in memory.
#pragma once

#include "clean_plan.hpp"
#include "take_jobs.hpp"

namespace kinemend::cli {

/// Reads, cleans and writes one take as the plan says. What goes wrong with it is in the outcome.
Outcome try_take(const TakeJob& job, const CleanPlan& plan, const TakeProgress& progress = {});

}  // namespace kinemend::cli
