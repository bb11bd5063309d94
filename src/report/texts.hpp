// Declares the text of each command's result, and the words that these texts share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "clean/changes.hpp"
#include "kinemend/report.hpp"

namespace kinemend {

/// Returns the take's name, fit to print.
std::string shown_name(const TakeFacts& take);
/// Returns for example "1.5 deg per axis, slow, 90 % below 6.1 Hz; 30 Hz samples joined by lines".
/// `unit`: of the tracks.
std::string noise_words(const NoiseCharacter& noise, TakeKind kind, std::string_view unit,
                        double frame_rate_hz);
/// Returns for example "stand for 3.2 s, about 3.3 s expected, confidence 0.95".
std::string stand_words(const StandingTime& time);
/// Returns for example "video (given)" or "not known".
std::string source_words(const TakeSource& source);
/// Returns for example "; written to walk.clean.bvh"; empty for standard output.
std::string written_text(const TakeFacts& take);

/// Returns `Leftover::mend` with the path of the take.
std::string advice_of(const Leftover& leftover, const TakeFacts& take);
std::string clean_verdict(const TakeFacts& take, const CleanReport& report);

std::string check_verdict(const CheckReport& report);
/// Returns for example "frames 12-14: LTOE is missing (0.1 s)".
std::string finding_sentence(const Finding& finding, const TakeFacts& take,
                             const CheckReport& report);
/// Returns a figure of `check` with its unit; a whole number has no decimals.
std::string with_unit(double value, std::string_view unit);

/// Returns the methods that filled gaps, with their counts: "3 by pca, 1 by pchip".
std::string methods_text(const FillReport& report);
std::string fill_verdict(const FillOutcome& outcome);

/// Returns the text of `clean` about feet. Frames count from `first_frame`.
std::string feet_text(const FeetReport& report, std::int64_t first_frame, bool all);

/// Returns the text of the result of each command.
std::string result_text(const TakeFacts& take, const CleanReport& report,
                        const TextOptions& options);
std::string result_text(const TakeFacts& take, const CheckReport& report,
                        const TextOptions& options);
std::string result_text(const TakeFacts& take, const FillOutcome& outcome,
                        const TextOptions& options);
std::string result_text(const TakeFacts& take, const CompareOutcome& outcome,
                        const TextOptions& options);
inline std::string result_text(const TakeFacts& take, const FeetReport& report,
                               const TextOptions& options) {
  return feet_text(report, take.first_frame, options.all);
}

}  // namespace kinemend
