// Helpers for the heads of tables, and readers of the heads of single programs' exports.
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
/// Returns NaN if the text is not a finite number. A decimal comma is allowed.
double number_of(std::string_view text);
/// Returns a comma, semicolon or tab: the one that occurs most often in the line outside quotes.
char separator_of(std::string_view line);
/// Returns `decimal` if the first row can only be read with decimal commas.
CommaStyle commas_of(std::string_view rows, char separator);
/// Returns 3 if the text begins with a byte order mark, else 0.
std::size_t after_byte_order_mark(std::string_view text);

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

/// Whether the text begins with a section of Vicon's programs (Nexus and its predecessors), which
/// has a name and a rate.
bool starts_with_vicon_section(std::string_view text);
/// Reads the head of the trajectories. Errors: an export without trajectories.
CsvHeader read_vicon_header(const SourceText& text);

/// Whether the text begins with a head of OptiTrack's Motive.
bool starts_as_motive_export(std::string_view text);
/// Reads the columns of its markers. Errors: an export without markers.
CsvHeader read_motive_header(const SourceText& text);

}  // namespace kinemend
