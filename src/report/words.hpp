#pragma once

#include <string>

#include "kinemend/report.hpp"

// Words that several reports share.
namespace kinemend {

/// "joint" or "marker".
const char* noun_of(TakeKind kind);
/// The take's name for people, fit to print.
std::string shown_name(const TakeFacts& take);
/// "; written to walk.clean.bvh"; nothing for standard output.
std::string written_text(const TakeFacts& take);

}  // namespace kinemend
