// Tables of joints in CSV: rotations as quaternions, and positions.
#pragma once

#include <string>

#include "io/table/csv_document.hpp"
#include "io/table/marker_table.hpp"
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

}  // namespace kinemend
