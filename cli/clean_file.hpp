// Cleans one file of a plan and returns only text, so that a batch does not grow in memory.
#pragma once

#include "clean_plan.hpp"
#include "take_jobs.hpp"

namespace kinemend::cli {

/// Reads, cleans and writes one file by the plan. Errors of the file are in the outcome.
Outcome clean_file(const TakeJob& job, const CleanPlan& plan, const TakeProgress& progress = {});

}  // namespace kinemend::cli
