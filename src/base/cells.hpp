// Reads small tables that people edit: cells are separated by commas and quoted if necessary; `#`
// starts a comment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// The text without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);
/// Removes and returns the first line, without its line end (LF, CRLF or CR).
std::string_view take_line(std::string_view& text);

/// A line of a table with its number, from 1.
struct CellLine {
  std::size_t number = 0;
  std::vector<std::string> cells;
};
/// The lines that are neither blank nor comments. A quoted cell may contain commas and doubled
/// quotes, but no line break. `name` is for messages. Errors: `unreadable_input` with the line for
/// a quote without an end, or with more text after it.
std::vector<CellLine> cell_lines(std::string_view text, std::string_view name);

/// The text as a cell that `cell_lines` reads back: quoted if necessary.
std::string cell_of(std::string_view text);

/// The whole number in a cell, from `least` to 2^53; none for anything else.
std::optional<std::int64_t> whole_number(std::string_view cell, std::int64_t least);

}  // namespace kinemend
