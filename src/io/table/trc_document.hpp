// Keeps a TRC file as it was read so that it can be written back in its own layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/table/marker_table.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The lines above the rows of a TRC file.
struct TrcHeader {
  std::string_view first_line;  ///< `PathFileType ...`; empty if missing
  std::string first_cell;       ///< the name in the first line
  std::vector<std::string> keys;
  std::vector<std::string> values;
  std::size_t values_line = 0;  ///< byte of the line of values
  std::size_t labels_line = 0;
  std::vector<std::string> labels;  ///< after `Frame#` and `Time`, one per marker
  bool has_time = true;
  CellStyle style;  ///< style of the rows
  std::size_t data_begin = 0;

  /// Returns the value of a key; empty if the header lacks it.
  std::string_view value(std::string_view key) const;
  /// Returns the value of a key as a number; NaN if it is not finite. A decimal comma is allowed.
  double number(std::string_view key) const;
};

/// Parses up to the first row. Errors: `unreadable_input` with the line.
TrcHeader read_trc_header(const SourceText& text, Diagnostics& diagnostics);

/// A TRC file as it was read. The bytes hold every digit, so only a few offsets are stored with
/// them.
struct TrcDocument : SourceDocument {
  std::string bytes;
  std::string first_line;
  MarkerTable table;
  std::vector<std::string> names;
  double frame_rate_hz = 0;
  std::int64_t first_frame = 1;
  std::string unit;
};

}  // namespace kinemend
