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
inline constexpr std::size_t most_columns = 4 * most_markers;

/// A table with a frame in each row and the coordinates of markers in its cells, as in TRC and CSV
/// files, and the reader's findings.
struct MarkerTable {
  std::size_t begin = 0;  ///< byte of the first row
  std::size_t end = 0;    ///< after the last row
  CellStyle style;
  std::int32_t frame_column = -1;  ///< -1 if missing
  std::int32_t time_column = -1;
  std::vector<std::array<std::size_t, 3>> columns;  ///< x, y, z for each marker
  std::size_t labelled_columns = 0;                 ///< columns with a label; 0: not known
  bool zeros_are_missing = false;                   ///< the format's convention if no cell is empty
  std::size_t frames = 0;
  std::vector<std::uint8_t> observed;  ///< F x M
  /// False if the head states a number that is not finite; a new file is then written.
  bool head_is_finite = true;

  /// Returns the number of cells in a full row, and up to the last one that is read.
  std::size_t width() const;
  std::size_t width_of_samples() const;
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

/// A table of markers as it was read: the bytes hold every digit, so only a few offsets and the
/// facts of the take are stored with them.
struct TableFile {
  std::string bytes;
  MarkerTable table;
  std::vector<std::string> names;
  double frame_rate_hz = 0;
  std::int64_t first_frame = 1;
  std::string unit;

  /// Whether the clip differs in samples only, and the head can be written again.
  bool fits(const Take& clip) const;
};

/// The contents of the rows besides the markers.
struct TableFinding {
  RowLabels labels;
  std::size_t widest = 0;    ///< used cells of the widest row, if it is wider than the table
  std::size_t wide_row = 0;  ///< byte of the first such row
};

/// Reads the rows from `file.table.begin` into `clip`, whose names are set, until the end or, once
/// `declared_frames` rows are read, a row that does not start with a number. If a row is wider than
/// the table, only `widest` is set and the clip has no frames. A last row that was cut before its
/// first sample is removed from the bytes. Repairs: `row_too_short`, `value_not_finite`,
/// `marker_incomplete`, `zero_is_missing`, `file_cut`, `trailing_text`. Errors: a cell that is not
/// a number.
TableFinding read_marker_table(const SourceText& text, std::size_t declared_frames, TableFile& file,
                               Take& clip);

/// Names each marker without a name *1, *2, ... by its position. `place`: the byte of the names.
/// Repair: `marker_unnamed`.
void name_the_unnamed(const SourceText& text, std::size_t place, Take& clip);

/// The rates at which people are captured. Chosen by hand, not swept.
inline constexpr double least_capture_hz = 5, most_capture_hz = 2000;

/// The rate from the times of the rows.
struct RowRate {
  double rate_hz = 0;      ///< 0 if the times do not give a rate
  double step_s = 0;       ///< mean of the steps
  double tolerance_s = 0;  ///< the possible error of rounded times
  bool is_even = false;    ///< no step differs from the mean
};

/// Reports irregular frame numbers and times (`frame_number_gap`, `time_uneven`), and sets the
/// first frame of the clip.
RowRate check_row_labels(const SourceText& text, const MarkerTable& table, const RowLabels& labels,
                         Take& clip);

/// Notes the repair `head_not_finite` at the byte of a line, and in the table.
void note_head_not_finite(const SourceText& text, std::size_t place, MarkerTable& table);
/// Whether a text of the head is `nan`, `inf` or a similar word.
bool is_not_finite(std::string_view text);

/// Throws an error that the cell at `place` is not a number.
[[noreturn]] void fail_at_cell(const SourceText& text, const char* place, char separator);

/// Returns the most decimals of any coordinate; 10 if it is more than 9, or a number has an
/// exponent.
unsigned decimals_of(const TableFile& file);

/// Returns the bytes of the file with every changed sample replaced, with the table's number of
/// decimals. Missing samples, and all cells without a finite number, become empty cells. Empty if
/// there is no file, the clip does not fit it, or the table cannot show missing samples: it has no
/// separators, or a row would have only empty cells.
std::optional<std::string> rewrite_marker_table(const Take& clip, const TableFile* file);

/// Replaces a frame number or a time that is not finite in the row of `patch`; returns whether the
/// row has an empty cell now.
bool mend_row_labels(const MarkerTable& table, double frame_number, CellPatch& patch);

/// How the rows of a new table are written.
struct TableStyle {
  char separator = '\t';
  std::string_view line_end = "\n";
  /// Coordinates have this number of decimals. Above 9 they have the fewest digits that read back
  /// as the same float if the value is a float, else as the same number.
  unsigned decimals = most_fixed_decimals + 1;
  unsigned most_decimals = most_fixed_decimals;  ///< above 9: no limit on the digits of a double
};
/// Appends the number and the time of a frame as the first cells of a row.
void append_row_labels(TextBuffer& out, std::int64_t frame, double time_s, char separator);
/// Appends a row for each frame: its number, its time, and the markers, empty if missing.
void append_marker_rows(TextBuffer& out, const Take& clip, const TableStyle& style);

/// The statements of a table about its rate.
struct TableRate {
  double stated_hz;            ///< NaN or 0 if the file states no rate
  std::size_t stated_place;    ///< byte of the rate, or of its expected place
  double asked_hz;             ///< from the options; 0: not given
  double unknown_hz;           ///< the format's own guess
  std::string_view stated_by;  ///< name of the field: `DataRate`
  std::size_t mismatch_place;  ///< byte for reports of a mismatch with the times
  std::string_view missing;    ///< message if no usable rate is stated
  bool must_be_stated;         ///< whether using times or options instead is a repair too
};

/// `rows_place`: byte of the first row. Returns the stated rate, else the rate of the times, else
/// the requested rate, else the guess. Repairs: `frame_rate_unusable`, `time_mismatch`,
/// `frame_rate_assumed`.
double table_rate(const SourceText& text, const RowRate& times, std::size_t rows_place,
                  const TableRate& said);

/// Finishes a clip of markers after its rows: sets its rate as `table_rate` does, and notes the
/// facts of the clip in the file.
void finish_markers(const SourceText& text, const RowLabels& labels, const TableRate& said,
                    TableFile& file, Take& clip);

/// Reads a table with `Reader(document, text, options).read()`, and keeps its bytes in the
/// `Document`, which becomes the take's source.
template <class Document, class Reader>
TakeResult read_table(std::string&& bytes, std::string_view name, std::string_view format,
                      const ReadOptions& options) {
  const auto document = std::make_shared<Document>();
  document->bytes = std::move(bytes);
  Diagnostics diagnostics;
  const SourceText text{name, document->bytes, options.strict, &diagnostics};
  Take take = Reader(*document, text, options).read();
  take.source.name = name;
  take.source.format = format;
  take.source.document = document;
  return {std::move(take), std::move(diagnostics)};
}

using Cells = std::vector<std::string>;

/// Returns NaN if the text is not a finite number. A decimal comma is allowed.
double number_of(std::string_view text);
/// Returns a comma, semicolon or tab: the one that occurs most often in the line outside quotes.
char separator_of(std::string_view line);
/// Returns `decimal` if the first row can only be read with decimal commas.
CommaStyle commas_of(std::string_view rows, char separator);

/// Walks over the lines of a head.
class HeadLines {
 public:
  HeadLines(const SourceText& text, std::size_t begin) : text_(&text), next_(begin) {}

  bool at_end() const { return next_ >= text_->bytes.size(); }
  std::size_t place() const { return place_; }  ///< place of the last line taken
  std::size_t next() const { return next_; }
  std::string_view take();
  /// Returns the cells of the next line. Errors: more columns than any table has.
  Cells take_cells();
  char separator() const { return separator_; }  ///< separator of the last cells taken

 private:
  const SourceText* text_;
  std::size_t place_ = 0;
  std::size_t next_ = 0;
  char separator_ = ',';
};

}  // namespace kinemend
