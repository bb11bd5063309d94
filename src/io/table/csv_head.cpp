// Splits the heads of tables into lines and cells, and guesses separators and decimal commas.
#include "io/table/csv_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace kinemend {

std::string_view without_spaces_around(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

double number_of(std::string_view text) {
  if (!text.empty()) {
    const NumberToken token =
        read_number(text.data(), text.data() + text.size(), CommaStyle::decimal);
    const bool whole = token.end == text.data() + text.size();
    if (whole && token.kind == TokenKind::number) return token.value;
  }
  return std::nan("");
}

char separator_of(std::string_view line) {
  constexpr std::string_view separators = ",;\t";
  std::array<std::size_t, 3> counts{};
  bool quoted = false;
  for (const char c : line) {
    quoted = quoted != (c == '"');
    const std::size_t at = separators.find(c);
    if (!quoted && at != separators.npos) ++counts[at];
  }
  return separators[static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) -
                                             counts.begin())];
}

CommaStyle commas_of(std::string_view rows, char separator) {
  const Cells cells = split_cells(line_from(rows, 0), separator);
  const bool decimal = separator == ','
                           ? std::any_of(cells.begin(), cells.end(),
                                         [](const auto& c) { return c.find(',') != c.npos; })
                           : rows.find(',') != rows.npos;
  return decimal ? CommaStyle::decimal : CommaStyle::none;
}

std::size_t after_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.substr(0, mark.size()) == mark ? mark.size() : 0;
}

std::string_view HeadLines::take() {
  place_ = next_;
  next_ = next_line(text_->bytes, next_);
  return line_from(text_->bytes, place_);
}

Cells HeadLines::take_cells() {
  const std::string_view line = take();
  separator_ = separator_of(line);
  const auto separators = std::count(line.begin(), line.end(), separator_);
  if (static_cast<std::size_t>(separators) > most_columns) {
    throw text_->error_at(place_, fmt::format("at most {} columns can be read", most_columns));
  }
  return split_cells(line, separator_);
}

}  // namespace kinemend
