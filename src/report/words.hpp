// Words that several reports share.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/report.hpp"

namespace kinemend {

/// "joint" or "marker".
const char* noun_of(TakeKind kind);
/// The take's name for people, fit to print.
std::string shown_name(const TakeFacts& take);
/// "1.5 deg per axis, slow, 90 % below 6.1 Hz; 30 Hz samples joined by lines". `unit`: of the
/// tracks.
std::string noise_words(const NoiseCharacter& noise, TakeKind kind, std::string_view unit,
                        double frame_rate_hz);
/// "; written to walk.clean.bvh"; nothing for standard output.
std::string written_text(const TakeFacts& take);

}  // namespace kinemend
