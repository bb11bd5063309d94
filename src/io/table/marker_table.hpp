// Reads and rewrites tables with coordinates of markers in their cells, for TRC, TSV and CSV, and
// holds the functions that readers of tables share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/cells.hpp"
#include "io/text/text.hpp"
#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A file that claims more markers than this is rejected. Chosen by hand.
inline constexpr std::size_t most_markers = 16384;

/// A table with a frame in each row and the coordinates of markers in its cells, as in TRC and CSV
/// files, and the reader's findings.
struct MarkerTable {
  std::size_t begin = 0;  ///< byte of the first row
  std::size_t end = 0;    ///< after the last row
  CellStyle style;
  std::int32_t frame_column = -1;  ///< -1 if missing
  std::int32_t time_column = -1;
  std::vector<std::array<std::size_t, 3>> columns;  ///< x, y, z for each marker
  bool zeros_are_missing = false;                   ///< the format's convention if no cell is empty
  std::size_t frames = 0;
  std::vector<std::uint8_t> observed;  ///< F x M
  /// False if the head states a number that is not finite; a new file is then written.
  bool head_is_finite = true;

  /// Returns the number of cells in a full row.
  std::size_t width() const;
  /// Whether a row has only separators, as spreadsheets write, although a frame would have its
  /// number or time.
  bool is_filler(const CellRow& row) const {
    return row.used == 0 && (frame_column >= 0 || time_column >= 0);
  }
};

/// Frame numbers and times in seconds of the rows, NaN for an empty cell; empty vectors without
/// such a column.
struct RowLabels {
  std::vector<double> frames;
  std::vector<double> times_s;
};

/// The contents of the rows besides the markers.
struct TableFinding {
  RowLabels labels;
  std::size_t widest = 0;    ///< used cells of the widest row, if it is wider than the table
  std::size_t wide_row = 0;  ///< byte of the first such row
  /// Byte of a last row that was cut before its first sample; it is ignored, and the file ends
  /// before it.
  std::optional<std::size_t> cut_row;
};

/// Reads the rows from `table.begin` into `clip`, whose names are set, until the end or, once
/// `declared_frames` rows are read, a row that does not start with a number. If a row is wider than
/// the table, only `widest` is set and the clip has no frames. Repairs: `row_too_short`,
/// `value_not_finite`, `marker_incomplete`, `zero_is_missing`, `file_cut`, `trailing_text`.
/// Errors: a cell that is not a number.
TableFinding read_marker_table(const SourceText& text, Diagnostics& diagnostics,
                               std::size_t declared_frames, MarkerTable& table, Take& clip);

/// Names each marker without a name *1, *2, ... by its position. `place`: the byte of the names.
/// Repair: `marker_unnamed`.
void name_the_unnamed(const SourceText& text, Diagnostics& diagnostics, std::size_t place,
                      Take& clip);

/// The rate from the times of the rows.
struct RowRate {
  double rate_hz = 0;      ///< 0 if the times do not give a rate
  double step_s = 0;       ///< mean of the steps
  double tolerance_s = 0;  ///< the possible error of rounded times
};

/// Reports irregular frame numbers and times (`frame_number_gap`, `time_uneven`), and sets the
/// first frame of the clip.
RowRate check_row_labels(const SourceText& text, Diagnostics& diagnostics, const MarkerTable& table,
                         const RowLabels& labels, Take& clip);

/// The message of the repair `head_not_finite`.
inline constexpr std::string_view head_not_finite_text =
    "a number in the head is not finite: it is ignored and not written";
/// Whether a text of the head is `nan`, `inf` or a similar word.
bool is_not_finite(std::string_view text);

/// Throws an error that the cell at `place` is not a number.
[[noreturn]] void fail_at_cell(const SourceText& text, const char* place, char separator);

/// Returns the most decimals of any coordinate; 10 if it is more than 9, or a number has an
/// exponent.
unsigned decimals_of(std::string_view bytes, const MarkerTable& table);

/// Returns the bytes with every changed sample replaced, with the table's number of decimals.
/// Missing samples, and all cells without a finite number, become empty cells. The result is empty
/// if the table cannot show them: it has no separators, or a row would have only empty cells. The
/// clip must have the table's frames and markers.
std::optional<std::string> rewrite_marker_table(const Take& clip, std::string_view bytes,
                                                const MarkerTable& table);

/// Returns the text of a coordinate in a file without a source: the fewest digits that read back as
/// the same float if the value is a float, else as the same number, with at most `most_decimals`
/// digits after the point unless that is more than 9. `room` must hold `fixed_number_room`
/// characters.
std::string_view coordinate_text(double value, char* room, unsigned most_decimals);

/// The statements of a table about its rate.
struct TableRate {
  double stated_hz;            ///< NaN or 0 if the file states no rate
  std::size_t stated_place;    ///< byte of the rate, or of its expected place
  std::size_t rows_place;      ///< byte of the first row
  double asked_hz;             ///< from the options; 0: not given
  double unknown_hz;           ///< the format's own guess
  std::string_view stated_by;  ///< name of the field: `DataRate`
  std::size_t mismatch_place;  ///< byte for reports of a mismatch with the times
  std::string_view missing;    ///< message if no usable rate is stated
  bool must_be_stated;         ///< whether using times or options instead is a repair too
};

/// Returns the stated rate, else the rate of the times, else the requested rate, else the guess.
/// Repairs: `frame_rate_unusable`, `time_mismatch`, `frame_rate_assumed`.
double table_rate(const SourceText& text, Diagnostics& diagnostics, const RowRate& times,
                  const TableRate& said);

/// Reads a table with `Reader(document, name, options).read()`, and keeps its bytes in the
/// `Document`, which becomes the take's source.
template <class Document, class Reader>
TakeResult read_table(std::string&& bytes, std::string_view name, std::string_view format,
                      const ReadOptions& options) {
  const auto document = std::make_shared<Document>();
  document->bytes = std::move(bytes);
  TakeResult result = Reader(*document, name, options).read();
  SourceInfo& source = result.take.source;
  source.name = name;
  source.format = format;
  source.document = document;
  return result;
}

}  // namespace kinemend
