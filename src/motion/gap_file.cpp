// The side file of gaps.

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/gaps.hpp"

namespace kinemend {

namespace {

constexpr std::string_view heading = "name,first_frame,last_frame";
constexpr std::string_view blanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// Removes and returns the first line, without its end (LF, CRLF or CR).
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

// Removes and returns a cell, and the comma behind it; a quoted cell doubles its quotes. None for a
// quote that does not end, or that ends inside the cell.
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
      throw Error::at_line(name, number, "expected a quoted name that ends with its quote");
    cells.push_back(*cell);
    if (line.empty()) return cells;
    line.remove_prefix(1);
  }
}

// From `least` on.
std::optional<std::int64_t> frame_number(std::string_view text, std::int64_t least) {
  // More than any take has, and such that sums of two do not overflow.
  constexpr std::int64_t most = std::int64_t{1} << 53;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (value < least || value > most) return std::nullopt;
  return value;
}

bool starts_with_digit(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

NamedGap gap_of(const std::vector<std::string>& cells, std::string_view name, std::size_t number,
                std::int64_t first_frame) {
  const auto first = frame_number(cells[1], first_frame);
  const auto last = frame_number(cells[2], first_frame);
  if (!first || !last) {
    throw Error::at_line(name, number,
                         fmt::format("expected a frame number from {}, found \"{}\"", first_frame,
                                     first ? cells[2] : cells[1]));
  }
  if (*last < *first) {
    throw Error::at_line(name, number,
                         fmt::format("the last frame, {}, is before the first, {}", *last, *first));
  }
  return {cells[0], static_cast<std::size_t>(*first - first_frame),
          static_cast<std::size_t>(*last - first_frame)};
}

std::string quoted(const std::string& name) {
  const bool plain = name.find_first_of(",\"#") == std::string::npos && trimmed(name) == name;
  if (plain && !name.empty()) return name;
  std::string result = "\"";
  for (const char c : name) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

}  // namespace

std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name) {
  return parse_gaps(text, name, 1);
}

std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name,
                                 std::int64_t first_frame) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.compare(0, byte_order_mark.size(), byte_order_mark) == 0) {
    text.remove_prefix(byte_order_mark.size());
  }
  std::vector<NamedGap> gaps;
  bool may_be_heading = true;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line, name, number);
    if (cells.size() != 3) {
      throw Error::at_line(name, number,
                           fmt::format("expected name,first,last, found {} cell{}", cells.size(),
                                       cells.size() == 1 ? "" : "s"));
    }
    const bool is_heading =
        may_be_heading && !starts_with_digit(cells[1]) && !starts_with_digit(cells[2]);
    may_be_heading = false;
    if (!is_heading) gaps.push_back(gap_of(cells, name, number, first_frame));
  }
  return gaps;
}

std::string gaps_text(std::span<const NamedGap> gaps) { return gaps_text(gaps, 1); }

std::string gaps_text(std::span<const NamedGap> gaps, std::int64_t first_frame) {
  std::string text = fmt::format("{}\n", heading);
  for (const NamedGap& gap : gaps) {
    text += fmt::format("{},{},{}\n", quoted(gap.name),
                        static_cast<std::int64_t>(gap.first_frame) + first_frame,
                        static_cast<std::int64_t>(gap.last_frame) + first_frame);
  }
  return text;
}

}  // namespace kinemend
