// Reads and writes tables of joints in CSV, rotations as quaternions and positions, and the lines
// that hold their skeleton.
#pragma once

#include <string>

#include "io/table/csv_document.hpp"
#include "io/table/marker_table.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The columns of a table of joints.
struct JointColumns {
  std::vector<std::array<std::size_t, 4>> rotations;  ///< J times w, x, y, z
  /// Root, then the translated joints; the first is unused without a root position.
  std::vector<std::array<std::size_t, 3>> positions;
  bool has_root = false;
};

/// Reads a table of joints. Repairs: `skeleton_missing`, `rotation_missing`, `position_missing`,
/// `rotation_not_unit`, `value_not_finite`, `row_too_short`. Errors: `unreadable_input`, naming the
/// line.
Take read_csv_joints(const SourceText& text, Diagnostics& diagnostics, const CsvHeader& header,
                     CsvDocument& document, RowLabels& labels);

/// The document's bytes with every changed sample replaced. The clip has its skeleton and frames.
std::string rewrite_csv_joints(const Take& clip, const CsvDocument& document);

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
