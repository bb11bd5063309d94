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
  std::string_view first_line;  ///< `PathFileType ...`; empty where there is none
  std::string first_cell;       ///< the name that the first line gives
  std::vector<std::string> keys;
  std::vector<std::string> values;
  std::size_t values_line = 0;  ///< byte of the line of values
  std::size_t labels_line = 0;
  std::vector<std::string> labels;  ///< after `Frame#` and `Time`, one per marker
  bool has_time = true;
  CellStyle style;  ///< of the rows
  std::size_t data_begin = 0;

  /// The value of a key; empty where the header lacks it.
  std::string_view value(std::string_view key) const;
  /// The same as a number; NaN where it is not finite. A decimal comma is allowed.
  double number(std::string_view key) const;
};

/// Parses up to the first row. Errors: `unreadable_input` with the line.
TrcHeader read_trc_header(const SourceText& text, Diagnostics& diagnostics);

/// A TRC file as it was read: the bytes hold every digit, so beside them only landmarks are kept.
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
