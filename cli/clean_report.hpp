#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "clean_plan.hpp"
#include "kinemend/diagnostics.hpp"
#include "report_view.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

/// "noisy: 1.5 deg jitter on 31 joints, 52 spikes"
std::string verdict(const ReportView& report);
/// The take's name, the verdict and where the result went, on one line.
std::string headline(const CleanJob& job, const ReportView& report, const CleanPlan& plan,
                     const Colours& colours);
/// What follows the headline: a table of what changed, the gaps, and the sums.
std::string report_text(const ReportView& report, bool all_rows);
/// One take's entry in `--json`, and with `spans` in `--report`. Frames count from 1.
nlohmann::ordered_json report_json(const CleanJob& job, const ReportView& report,
                                   const Diagnostics& diagnostics, const CleanPlan& plan,
                                   bool with_spans);

}  // namespace kinemend::cli
