// Helpers for the heads of tables, and the heads of exports of single programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/table/csv_document.hpp"

namespace kinemend {

using Cells = std::vector<std::string>;

inline constexpr std::size_t most_columns = 4 * most_markers;

std::string_view without_spaces_around(std::string_view text);
/// NaN where the text is not a finite number. A decimal comma is allowed.
double number_of(std::string_view text);
/// A comma, semicolon or tab: whichever the line has most of outside quotes.
char separator_of(std::string_view line);
/// Decimal where the first row can only be read with decimal commas.
CommaStyle commas_of(std::string_view rows, char separator);
/// 3 where a byte order mark starts the text, else 0.
std::size_t after_byte_order_mark(std::string_view text);

/// Walks over the lines of a head.
class HeadLines {
 public:
  HeadLines(const SourceText& text, std::size_t begin) : text_(&text), next_(begin) {}

  bool at_end() const { return next_ >= text_->bytes.size(); }
  std::size_t place() const { return place_; }  ///< of the line that was taken last
  std::size_t next() const { return next_; }
  std::string_view take();
  /// The cells of the next line. Errors: more columns than any table has.
  Cells take_cells();
  char separator() const { return separator_; }  ///< of the cells that were taken last

 private:
  const SourceText* text_;
  std::size_t place_ = 0;
  std::size_t next_ = 0;
  char separator_ = ',';
};

/// Sections under names and rates, as Vicon's programs export them (Nexus, and those before it):
/// whether the text starts with one.
bool starts_with_vicon_section(std::string_view text);
/// The head of the trajectories. Errors: an export without them.
CsvHeader read_vicon_header(const SourceText& text);

/// A head of OptiTrack's Motive.
bool starts_as_motive_export(std::string_view text);
/// The columns of its markers. Errors: an export without markers.
CsvHeader read_motive_header(const SourceText& text);

}  // namespace kinemend
