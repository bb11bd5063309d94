// The quantity and the unit of a gap in the findings of a report.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/report.hpp"

namespace kinemend {

/// "rotation" or "position".
std::string_view quantity_of(const TakeFacts& take, const GapOutcome& gap);
/// Of the expected error; empty where it is not known.
std::string unit_of(const TakeFacts& take, const GapOutcome& gap);

}  // namespace kinemend
