// Copies a table of numbers with some of its cells replaced.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/cell_rows.hpp"
#include "io/text/text_buffer.hpp"

namespace kinemend {

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
