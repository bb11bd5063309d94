#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinemend::cli {

std::size_t display_width(std::string_view text) {
  // Bytes that continue a UTF-8 character take no column of their own.
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string Table::text() const {
  std::vector<std::size_t> widths(columns_.size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], display_width(row[c]));
  }
  std::string result;
  for (const auto& row : rows_) {
    std::string line(indent_, ' ');
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - display_width(row[c]), ' ');
      if (c > 0) line += "  ";
      line += columns_[c] == Align::left ? row[c] + padding : padding + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + "\n";
  }
  return result;
}

std::string wrap(std::string_view text, std::size_t indent, std::size_t width, bool hanging) {
  const std::string lead(indent, ' ');
  std::string result;
  std::string line = hanging ? "" : lead;
  std::size_t column = indent;
  bool is_empty = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (!is_empty && column + 1 + display_width(word) > width) {
      result += line + "\n";
      line = lead;
      column = indent;
      is_empty = true;
    }
    if (!is_empty) {
      line += ' ';
      ++column;
    }
    line += word;
    column += display_width(word);
    is_empty = false;
  }
  return result + line + "\n";
}

std::string figure(double value) {
  if (!std::isfinite(value)) return value > 0 ? "infinite" : "undefined";
  const double size = std::fabs(value);
  if (size == 0) return "0";
  if (size >= 1e9) return fmt::format("{:.3g}", value);
  if (size >= 100) return fmt::format("{:.0f}", value);
  if (size >= 10) return fmt::format("{:.1f}", value);
  if (size >= 1) return fmt::format("{:.2f}", value);
  if (size < 1e-6) return fmt::format("{:.3g}", value);
  // Three digits that count, whatever the unit: lengths in metres are small.
  const int decimals = 2 - static_cast<int>(std::floor(std::log10(size)));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // Not more zeros than figures from 1 on have.
  for (int d = decimals; d > 2 && text.back() == '0'; --d) text.pop_back();
  return text;
}

}  // namespace kinemend::cli
