// The verdict and the text of each command's result.
#pragma once

#include <cstdint>
#include <string>

#include "kinemend/report.hpp"

namespace kinemend {

std::string clean_verdict(const TakeFacts& take, const CleanOutcome& outcome);
std::string clean_text(const TakeFacts& take, const CleanOutcome& outcome,
                       const TextOptions& options);

std::string check_verdict(const CheckReport& report);
std::string check_text(const TakeFacts& take, const CheckReport& report,
                       const TextOptions& options);
/// "frames 12-14: LTOE is missing (0.1 s)".
std::string finding_sentence(const Finding& finding, const TakeFacts& take,
                             const CheckReport& report);
/// A figure of `check` with its unit; a whole number without decimals.
std::string with_unit(double value, std::string_view unit);

std::string fill_verdict(const FillOutcome& outcome);
std::string fill_text(const TakeFacts& take, const FillOutcome& outcome,
                      const TextOptions& options);

/// What `clean` says of feet. Frames count from `first_frame`.
std::string feet_text(const FeetReport& report, std::int64_t first_frame, bool all);

std::string comparison_text(const TakeFacts& take, const CompareOutcome& outcome,
                            const TextOptions& options);

}  // namespace kinemend
