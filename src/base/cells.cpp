// Splits small tables into lines and cells, quotes cells, and finds where JSON is nested too
// deeply.
#include "base/cells.hpp"

#include <algorithm>
#include <charconv>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

constexpr std::string_view blanks = " \t";

// Removes and returns a cell, and the comma after it; none for a quote without an end, or with more
// text after it.
std::optional<std::string> take_cell(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  std::string cell;
  if (line.empty() || line.front() != '"') {
    const std::size_t comma = std::min(line.find(','), line.size());
    cell = trimmed(line.substr(0, comma));
    line.remove_prefix(comma);
  } else {
    for (;;) {
      const std::size_t quote = line.find('"', 1);
      if (quote == std::string_view::npos) return std::nullopt;
      cell += line.substr(1, quote - 1);
      line.remove_prefix(quote + 1);
      if (line.empty() || line.front() != '"') break;
      cell += '"';
    }
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    if (!line.empty() && line.front() != ',') return std::nullopt;
  }
  return cell;
}

std::vector<std::string> cells_of(std::string_view line, std::string_view name,
                                  std::size_t number) {
  std::vector<std::string> cells;
  for (;;) {
    const auto cell = take_cell(line);
    if (!cell)
      throw Error::at_line(name, number, "expected a closing quote at the end of a quoted name");
    cells.push_back(*cell);
    if (line.empty()) return cells;
    line.remove_prefix(1);
  }
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view space = " \t\r";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find_first_of("\r\n");
  const std::string_view line = text.substr(0, end);
  if (end == std::string_view::npos) {
    text = {};
  } else {
    const bool crlf = text.compare(end, 2, "\r\n") == 0;
    text.remove_prefix(end + (crlf ? 2 : 1));
  }
  return line;
}

std::vector<CellLine> cell_lines(std::string_view text, std::string_view name) {
  text = without_byte_order_mark(text);
  std::vector<CellLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (line.empty() || line.front() == '#') continue;
    lines.push_back({number, cells_of(line, name, number)});
  }
  return lines;
}

std::string cell_of(std::string_view text) {
  const bool plain =
      text.find_first_of(",\"#\r\n") == std::string_view::npos && trimmed(text) == text;
  if (plain && !text.empty()) return std::string(text);
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    // A line break would end the row.
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result + '"';
}

std::optional<std::int64_t> whole_number(std::string_view cell, std::int64_t least) {
  // More than any take has; sums of two such numbers do not overflow. By definition.
  constexpr std::int64_t most = std::int64_t{1} << 53;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  if (value < least || value > most) return std::nullopt;
  return value;
}

std::string_view json_within_depth(std::string_view text) {
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      // The character after a backslash does not end the string.
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_json) return text.substr(0, i);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return text;
}

}  // namespace kinemend
