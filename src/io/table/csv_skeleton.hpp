// Writes and reads the lines of a CSV file that hold a skeleton.
#pragma once

#include <string>

#include "io/table/csv_document.hpp"
#include "io/text/text.hpp"
#include "kinemend/skeleton.hpp"

namespace kinemend {

/// Returns the lines of a skeleton, joint by joint, then end sites:
///   # joint 3: LeftKnee; parent 2; offset 0 -8.1 0; channels Zrotation Yrotation Xrotation
///   # end 0: Toe; parent 5; offset 0 0 1.2 `rest w x y z` is added if the rest rotation is not the
///   identity, `limits low high ...` if there are limits. A name with a semicolon, a quote or
///   blanks at its ends is quoted. Errors: `usage` for a name with a line end.
std::string skeleton_lines(const Skeleton& skeleton);

/// Returns the skeleton of such lines, without joints if there are no such lines. Errors:
/// `unreadable_input`, naming the line.
Skeleton read_skeleton_lines(const SourceText& text, const std::vector<CsvNote>& notes);

}  // namespace kinemend
