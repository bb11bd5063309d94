#pragma once

#include <string>

#include "json.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::cli {

/// Lines of the report of `clean`: how many contacts were held, slide, sink and knee pop before and
/// after, and what was left alone.
std::string feet_text(const FeetReport& report, bool all_rows);
/// Lengths in file units; frames from 1.
Json feet_json(const FeetReport& report);

}  // namespace kinemend::cli
