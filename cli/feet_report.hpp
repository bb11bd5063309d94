#pragma once

#include <cstdint>
#include <string>

#include "json.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::cli {

/// Lines of the report of `clean`: how many contacts were held, slide, sink and knee pop before and
/// after, and what was left alone.
std::string feet_text(const FeetReport& report, std::int64_t first_frame, bool all_rows);
/// Lengths in file units, null where no foot stands; frames as the file numbers them, from
/// `first_frame`.
Json feet_json(const FeetReport& report, std::int64_t first_frame);

}  // namespace kinemend::cli
