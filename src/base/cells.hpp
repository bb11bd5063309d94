#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Small tables that people edit: cells between commas, quoted where they must be, `#` comments.
namespace kinemend {

/// Without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);
/// Removes and returns the first line, without its end (LF, CRLF or CR).
std::string_view take_line(std::string_view& text);
/// Without the mark that some programs put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// A line of a table with its number, from 1.
struct CellLine {
  std::size_t number = 0;
  std::vector<std::string> cells;
};
/// The lines that are neither blank nor comments. A quoted cell doubles its quotes, and may hold
/// commas, but no line's end. `name` stands in messages. Errors: `unreadable_input` with the line
/// for a quote that does not end, or that ends inside a cell.
std::vector<CellLine> cell_lines(std::string_view text, std::string_view name);

/// The text as a cell that `cell_lines` reads back: quoted where it must be.
std::string cell_of(std::string_view text);

/// A whole number of a cell, from `least` to 2^53; none for anything else.
std::optional<std::int64_t> whole_number(std::string_view cell, std::int64_t least);

}  // namespace kinemend
