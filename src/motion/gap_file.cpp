// Reads and writes the side file of gaps.

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "base/cells.hpp"
#include "kinemend/error.hpp"
#include "kinemend/gaps.hpp"

namespace kinemend {

namespace {

constexpr std::string_view heading = "name,first_frame,last_frame";

bool starts_with_digit(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

NamedGap gap_of(const std::vector<std::string>& cells, std::string_view name, std::size_t number,
                std::int64_t first_frame) {
  const auto first = whole_number(cells[1], first_frame);
  const auto last = whole_number(cells[2], first_frame);
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

}  // namespace

std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name,
                                 std::int64_t first_frame) {
  std::vector<NamedGap> gaps;
  bool may_be_heading = true;
  for (const auto& [number, cells] : cell_lines(text, name)) {
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

std::string gaps_text(std::span<const NamedGap> gaps, std::int64_t first_frame) {
  std::string text = fmt::format("{}\n", heading);
  for (const NamedGap& gap : gaps) {
    text += fmt::format("{},{},{}\n", cell_of(gap.name),
                        static_cast<std::int64_t>(gap.first_frame) + first_frame,
                        static_cast<std::int64_t>(gap.last_frame) + first_frame);
  }
  return text;
}

}  // namespace kinemend
