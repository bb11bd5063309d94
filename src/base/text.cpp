#include "kinemend/experimental/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinemend {

namespace {

std::string_view code_of(Paint paint) {
  switch (paint) {
    case Paint::bold:
      return "1";
    case Paint::dim:
      return "2";
    case Paint::red:
      return "1;31";
    case Paint::green:
      return "32";
    case Paint::yellow:
      return "33";
  }
  return "0";
}

}  // namespace

std::string painted(Paint paint, std::string_view text, bool on) {
  if (!on || text.empty()) return std::string(text);
  return fmt::format("\033[{}m{}\033[0m", code_of(paint), text);
}

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

std::string grouped(std::size_t count) {
  const std::string digits = fmt::format("{}", count);
  std::string result;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) result += ',';
    result += digits[i];
  }
  return result;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

std::string length_text(std::size_t frames, double frame_rate_hz) {
  return fmt::format("{} at {:.6g} Hz ({:.2f} s)", counted(frames, "frame"), frame_rate_hz,
                     frame_rate_hz > 0 ? static_cast<double>(frames) / frame_rate_hz : 0.0);
}

namespace {

// At most 80 characters of each word, and three dots where it was longer; paths are left whole, as
// their end says most.
std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 80;
  constexpr std::string_view blanks = " \t\r\n";
  std::string result;
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find_first_not_of(blanks), text.size());
    result += text.substr(0, blank);
    text.remove_prefix(blank);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    if (word.size() <= longest || word.find('/') != word.npos) {
      result += word;
      continue;
    }
    // Not within a character of several bytes.
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(word[end]) & 0xC0) == 0x80) --end;
    result += word.substr(0, end);
    result += "...";
  }
  return result;
}

}  // namespace

std::string printable(std::string_view whole) {
  const std::string text = shortened(whole);
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    // U+0080 to U+009F are control characters too.
    const bool is_c1 = byte == 0xC2 && next >= 0x80 && next <= 0x9F;
    if (byte < 0x20 || byte == 0x7F || is_c1) {
      result += fmt::format("\\x{:02x}", is_c1 ? next : byte);
      i += is_c1 ? 1 : 0;
    } else {
      result += text[i];
    }
  }
  return result;
}

}  // namespace kinemend
