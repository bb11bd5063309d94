// Walks over the rows of a table and reads the numbers in their cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_rows.hpp"
#include "io/text/number.hpp"

namespace kinemend {

/// How a table of text is laid out.
struct CellStyle {
  char separator = '\t';  ///< of cells: a tab, comma or semicolon; ' ' stands for runs of blanks,
                          ///< which leave no cell empty
  CommaStyle commas = CommaStyle::none;  ///< none or decimal
  std::vector<std::uint8_t> texts;       ///< by column: 1 where cells are text; may be short

  void mark_text(std::size_t column) {
    texts.resize(std::max(texts.size(), column + 1));
    texts[column] = 1;
  }
  bool is_text(std::size_t column) const { return column < texts.size() && texts[column] != 0; }
};

/// The line at `begin`, without its end.
std::string_view line_from(std::string_view text, std::size_t begin);
/// Where the line after the one at `begin` starts; the text's size after the last.
std::size_t next_line(std::string_view text, std::size_t begin);

/// About how many rows there are from `begin`, by the length of the first.
std::size_t estimate_rows(std::string_view text, std::size_t begin);

/// The cells of a line without blanks or quotes around them; two quotes within quotes are one. An
/// empty cell after the last separator is left out.
std::vector<std::string> split_cells(std::string_view line, char separator);
/// The cell that `split_cells` reads as this text without line ends: in quotes where a blank at
/// either end, a quote or the separator would get lost without them.
std::string cell_of(std::string_view text, char separator);

/// A row as it was read.
struct CellRow {
  std::size_t cells = 0;        ///< an empty one after the last separator is left out
  std::size_t used = 0;         ///< up to the last that is not empty
  const char* end = nullptr;    ///< of the line
  const char* fault = nullptr;  ///< the first cell that is not a number
};

/// Walks over the rows of a table of numbers, a line each. An empty cell, or one with no finite
/// number, is NaN. Lines of white space (tabs too) are skipped.
class CellRows {
 public:
  CellRows(std::string_view text, std::size_t begin, CellStyle style);

  /// Moves to the next row; false at the end.
  bool next();
  /// Where the row starts.
  std::size_t position() const { return static_cast<std::size_t>(line_ - begin_); }
  /// The row's first `count` cells. `tokens`, unless null, takes the place of each: where it would
  /// stand when it is empty, null when the row ends before it.
  CellRow read(double* values, std::size_t count, TokenSpan* tokens = nullptr);

  std::size_t not_finite() const { return not_finite_; }  ///< cells such as `nan`
  const char* first_not_finite() const { return first_not_finite_; }

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
  std::size_t not_finite_ = 0;
  const char* first_not_finite_ = nullptr;
};

}  // namespace kinemend
