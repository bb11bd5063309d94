// Tables with the coordinates of markers in their cells, which TRC, TSV and CSV share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/cell_rows.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A file that claims more markers than this is rejected. Chosen by hand.
inline constexpr std::size_t most_markers = 16384;

/// A table with a frame in each row and the coordinates of markers in its cells, as in TRC and CSV
/// files, and what a reader found in it.
struct MarkerTable {
  std::size_t begin = 0;  ///< byte of the first row
  std::size_t end = 0;    ///< after the last row
  CellStyle style;
  std::int32_t frame_column = -1;  ///< -1 where there is none
  std::int32_t time_column = -1;
  std::vector<std::array<std::size_t, 3>> columns;  ///< of x, y, z, one a marker
  bool zeros_are_missing = false;  ///< the format's convention where no cell is empty
  std::size_t frames = 0;
  std::vector<std::uint8_t> observed;  ///< F x M
  bool head_is_finite = true;  ///< false where the head states a number that is not finite; the
                               ///< file is then written anew

  /// Cells in a full row.
  std::size_t width() const;
  /// Whether a row has separators only, as spreadsheets leave behind, although a frame would have
  /// its number or time.
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

/// The content of the rows beside the markers.
struct TableFinding {
  RowLabels labels;
  std::size_t widest = 0;    ///< used cells of the widest row, when it is wider than the table
  std::size_t wide_row = 0;  ///< byte of the first such row
  std::optional<std::size_t> cut_row;  ///< byte of a last row that was cut before its first sample
                                       ///< and does not count; the file ends there from now on
};

/// Reads the rows from `table.begin` into `clip`, whose names are set, until the end or, once
/// `declared_frames` rows are read, a row that does not start with a number. When a row is wider
/// than the table, only `widest` is found and the clip has no frames. Repairs: `row_too_short`,
/// `value_not_finite`, `marker_incomplete`, `zero_is_missing`, `file_cut`, `trailing_text`.
/// Errors: a cell that is no number.
TableFinding read_marker_table(const SourceText& text, Diagnostics& diagnostics,
                               std::size_t declared_frames, MarkerTable& table, Take& clip);

/// The rate that the times of the rows give.
struct RowRate {
  double rate_hz = 0;      ///< 0 where they give none
  double step_s = 0;       ///< mean of the steps
  double tolerance_s = 0;  ///< the possible error of rounded times
};

/// Notes oddities of frame numbers and times (`frame_number_gap`, `time_uneven`), and sets the
/// first frame of the clip.
RowRate check_row_labels(const SourceText& text, Diagnostics& diagnostics, const MarkerTable& table,
                         const RowLabels& labels, Take& clip);

/// The words of the repair `head_not_finite`.
inline constexpr std::string_view head_not_finite_text =
    "a number in the head is not finite: it is ignored and not written";
/// Whether a text of the head is `nan`, `inf` or the like.
bool is_not_finite(std::string_view text);

/// Throws an error that the cell at `place` is not a number.
[[noreturn]] void fail_at_cell(const SourceText& text, const char* place, char separator);

/// Most decimals of any coordinate; 10 where it is more than 9, or one has an exponent.
unsigned decimals_of(std::string_view bytes, const MarkerTable& table);

/// The bytes with every changed sample replaced, with as many decimals as the table has. Missing
/// samples, and all cells that hold no finite number, become empty cells. Empty where the table
/// cannot show them: it has no separators, or a row would have empty cells alone. The clip has the
/// table's frames and markers.
std::optional<std::string> rewrite_marker_table(const Take& clip, std::string_view bytes,
                                                const MarkerTable& table);

/// The text of a coordinate in a file without a source: the fewest digits that read back as the
/// same float where the value is one, else as the same number, with at most `most_decimals` digits
/// after the point unless that is more than 9. `room` holds `fixed_number_room` characters.
std::string_view coordinate_text(double value, char* room, unsigned most_decimals);

}  // namespace kinemend
