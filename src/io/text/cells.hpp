// The cells of a table of text: walks over its rows and reads their numbers, and copies a table
// with some of its cells replaced.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/text.hpp"

namespace kinemend {

/// How a table of text is laid out.
struct CellStyle {
  /// Separator of cells: a tab, comma or semicolon; ' ' means runs of blanks, which leave no cell
  /// empty.
  char separator = '\t';
  CommaStyle commas = CommaStyle::none;  ///< none or decimal
  std::vector<std::uint8_t> texts;  ///< by column: 1 if cells are text; may be shorter than a row

  void mark_text(std::size_t column) {
    texts.resize(std::max(texts.size(), column + 1));
    texts[column] = 1;
  }
  bool is_text(std::size_t column) const { return column < texts.size() && texts[column] != 0; }
};

/// Returns the line at `begin`, without its end.
std::string_view line_from(std::string_view text, std::size_t begin);
/// Returns the start of the line after the line at `begin`; the text's size after the last line.
std::size_t next_line(std::string_view text, std::size_t begin);

/// Estimates the number of rows from `begin` by the length of the first row.
std::size_t estimate_rows(std::string_view text, std::size_t begin);

/// Returns the cells of a line without surrounding blanks or quotes; two quotes within quotes are
/// one. An empty cell after the last separator is left out.
std::vector<std::string> split_cells(std::string_view line, char separator);
/// Returns the cell that `split_cells` reads as this text without line ends. It is quoted if a
/// blank at either end, a quote or the separator would be lost otherwise.
std::string cell_of(std::string_view text, char separator);

/// Returns the content of a cell without its quotes and the blanks within them; an empty span for
/// quotes around nothing.
TokenSpan content_of(TokenSpan cell, char separator);

/// A row as it was read.
struct CellRow {
  std::size_t cells = 0;        ///< an empty cell after the last separator is left out
  std::size_t used = 0;         ///< number of cells up to the last that is not empty
  const char* end = nullptr;    ///< end of the line
  const char* fault = nullptr;  ///< the first cell that is not a number
};

/// Walks over the rows of a table of numbers, one row per line. An empty cell, or a cell without a
/// finite number, is NaN. Lines of white space (tabs too) are skipped.
class CellRows {
 public:
  CellRows(std::string_view text, std::size_t begin, CellStyle style);

  /// Moves to the next row; false at the end.
  bool next();
  /// Returns the offset of the row.
  std::size_t position() const { return static_cast<std::size_t>(line_ - begin_); }
  /// Reads the row's first `count` cells. `tokens`, unless null, receives the place of each cell;
  /// for an empty cell the place where its text would be, null if the row ends before it.
  CellRow read(double* values, std::size_t count, TokenSpan* tokens = nullptr);

  const CountedRepair<const char*>& not_finite() const { return not_finite_; }  ///< such as `nan`

 private:
  struct Output;
  struct Cell {
    TokenSpan token;
    const char* next = nullptr;  ///< the separator or the end of the line
  };

  template <char separator>
  CellRow read_separated(const Output& out);
  CellRow read_words(const Output& out);
  Cell find_cell(const char* p) const;
  double value_of(TokenSpan token, std::size_t column, CellRow& row);

  const char* begin_;
  const char* end_;
  const char* line_;
  const char* next_line_;
  PlainPlaces plain_places_;
  CellStyle style_;
  CountedRepair<const char*> not_finite_;
};

/// More decimals than this are written as the fewest digits that read back as the same number.
/// Chosen by hand.
inline constexpr unsigned most_fixed_decimals = 9;

/// Copies a table of numbers with some cells replaced.
class CellPatch {
 public:
  /// `begin`: offset of the first row. All rows are `width` cells wide.
  CellPatch(std::string_view bytes, std::size_t begin, const CellStyle& style, std::size_t width);

  /// Writes the replacements of this row and moves to the next; false at the end.
  bool next();
  const CellRow& row() const { return row_; }
  /// Returns the value as read; NaN for an empty cell.
  double value(std::size_t column) const { return values_[column]; }
  /// Whether the cell holds a word such as `nan` instead of a number. Quotes around nothing are an
  /// empty cell.
  bool is_no_number(std::size_t column) const {
    const TokenSpan content = content_of(tokens_[column], style_.separator);
    return std::isnan(values_[column]) && content.begin != content.end;
  }
  /// Replaces a cell. NaN makes an empty cell, or `NaN` in a table without separators. The old
  /// digits are kept if they express the new value as accurately as `decimals` digits can.
  void replace(std::size_t column, double value, unsigned decimals);
  bool has_replacements() const { return !replacements_.empty(); }
  /// Whether the replacements leave only empty cells in this row, so that it would no longer be
  /// read as a row.
  bool empties_row() const;
  /// Appends the remaining bytes unchanged and returns the result.
  std::string finish() &&;

 private:
  struct Replacement {
    std::size_t column = 0;
    double value = 0;
    unsigned decimals = 0;
  };

  void append(const Replacement& replacement);
  void copy_until(const char* place);
  void write_row();
  std::size_t grow(std::size_t column, const Replacement& last);

  std::string_view bytes_;
  CellStyle style_;
  std::size_t width_;
  CellRows rows_;
  CellRow row_;
  std::vector<double> values_;
  std::vector<TokenSpan> tokens_;
  std::vector<Replacement> replacements_;
  TextBuffer out_;
  const char* copied_;
};

}  // namespace kinemend
