#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/cell_rows.hpp"
#include "io/text/text.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// More markers than this are taken for garbage.
inline constexpr std::size_t most_markers = 16384;

/// A table with a frame in each row and the coordinates of markers in its cells, as TRC and CSV
/// have it; and what a reader made of it.
struct MarkerTable {
  std::size_t begin = 0;  ///< byte of the first row
  std::size_t end = 0;    ///< after the last row
  CellStyle style;
  std::int32_t frame_column = -1;  ///< -1 where there is none
  std::int32_t time_column = -1;
  std::vector<std::array<std::size_t, 3>> columns;  ///< of x, y, z, one a marker
  bool zeros_are_missing = false;  ///< by custom of the format, where no cell is empty
  std::size_t frames = 0;
  std::vector<std::uint8_t> observed;  ///< F x M

  /// Cells in a full row.
  std::size_t width() const;
  /// A row of separators only, as spreadsheets leave behind, where a frame would have its number or
  /// time.
  bool is_filler(const CellRow& row) const {
    return row.used == 0 && (frame_column >= 0 || time_column >= 0);
  }
};

/// Frame numbers and times in seconds of the rows, NaN where a cell is empty; empty vectors where
/// there is no such column.
struct RowLabels {
  std::vector<double> frames;
  std::vector<double> times_s;
};

/// What the rows of a table have in common with no marker.
struct TableFinding {
  RowLabels labels;
  std::size_t widest = 0;    ///< used cells of the widest row, when it is wider than the table
  std::size_t wide_row = 0;  ///< byte of the first such row
};

/// Reads the rows from `table.begin` into `clip`, whose names are set, until the end or, once
/// `declared_frames` rows are read, a row that does not start with a number. When a row is wider
/// than the table, only `widest` is found and the clip has no frames. Repairs: `row_too_short`,
/// `value_not_finite`, `marker_incomplete`, `zero_is_missing`, `file_cut`, `trailing_text`.
/// Errors: a cell that is no number.
TableFinding read_marker_table(const SourceText& text, Diagnostics& diagnostics,
                               std::size_t declared_frames, MarkerTable& table, MarkerClip& clip);

/// What the times of the rows tell.
struct RowRate {
  double rate_hz = 0;      ///< 0 where they tell none
  double step_s = 0;       ///< mean of the steps
  double tolerance_s = 0;  ///< by which rounded times may be off
};

/// Notes what is odd about frame numbers and times, and sets the clip's first frame:
/// `frame_number_gap`, `time_uneven`.
RowRate check_row_labels(const SourceText& text, Diagnostics& diagnostics, const MarkerTable& table,
                         const RowLabels& labels, MarkerClip& clip);

/// Throws that the cell at `place` is no number.
[[noreturn]] void fail_at_cell(const SourceText& text, const char* place, char separator);

/// Most decimals of any coordinate; 10 where it is more than 9, or one has an exponent.
unsigned decimals_of(std::string_view bytes, const MarkerTable& table);

/// The bytes with every changed sample replaced: by as many decimals as the table has, by empty
/// cells where it is missing now (`NaN` in a table without separators). The clip has the table's
/// frames and markers.
std::string rewrite_marker_table(const MarkerClip& clip, std::string_view bytes,
                                 const MarkerTable& table);

/// A coordinate of a file without a layout of its own: the fewest digits that read back as the same
/// float where the value is one, else as the same number, then with no more than `most_decimals`
/// unless that is more than 9. `room` holds `fixed_number_room` characters.
std::string_view coordinate_text(double value, char* room, unsigned most_decimals);

}  // namespace kinemend
