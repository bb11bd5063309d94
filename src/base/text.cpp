// Formats text for display: tables, wrapped lines, figures, measured values and colours. It escapes
// characters that must not reach a terminal and shortens quoted text.
#include "base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "kinemend/extend/text.hpp"

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

std::size_t byte_order_mark_size(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? mark.size() : 0;
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(byte_order_mark_size(text));
}

std::size_t display_width(std::string_view text) {
  // Continuation bytes of a UTF-8 character take no column of their own.
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

namespace {

// Chosen by hand.
constexpr std::size_t longest_word = 80;       // characters
constexpr std::size_t longest_message = 2000;  // bytes
constexpr std::size_t head_of_message = 1200;  // bytes of a longer one, before its end
constexpr std::string_view omitted = "...";

// The character as displayed: itself, or its code in ASCII.
std::string shown(const Character& character, std::string_view text) {
  if (!character.is_valid)
    return fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
  if (!commands_terminal(character.code)) return std::string(text.substr(0, character.size));
  return character.code < 0x100 ? fmt::format("\\x{:02x}", character.code)
                                : fmt::format("\\u{:04x}", character.code);
}

// `most`: characters as displayed; the rest of a longer text is left out.
std::string escaped(std::string_view text, std::size_t most = std::string_view::npos) {
  std::string result;
  std::size_t count = 0;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::string piece = shown(character, text);
    count += display_width(piece);
    if (count > most) return result + std::string(omitted);
    result += piece;
    text.remove_prefix(character.size);
  }
  return result;
}

bool is_cut(std::string_view word) {
  return word.ends_with(omitted) && display_width(word) <= longest_word + omitted.size();
}

// Shortens long words of an escaped text. Paths are kept whole, as their end is informative.
std::string with_short_words(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t blanks = std::min(text.find_first_not_of(' '), text.size());
    result.append(blanks, ' ');
    text.remove_prefix(blanks);
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    const bool is_path = word.find('/') != word.npos;
    result += is_path || is_cut(word) ? std::string(word) : escaped(word, longest_word);
  }
  return result;
}

// The start of the character at `place`, where a text may be cut.
std::size_t boundary(std::string_view text, std::size_t place) {
  while (place > 0 && (static_cast<unsigned char>(text[place]) & 0xC0) == 0x80) --place;
  return place;
}

}  // namespace

void Table::add(std::vector<std::string> cells) {
  for (std::string& cell : cells) cell = with_short_words(escaped(cell));
  rows_.push_back(std::move(cells));
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

std::string wrap(std::string_view whole, std::size_t indent, std::size_t width, bool hanging) {
  const std::string safe = escaped(whole);
  std::string_view text = safe;
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
  // Three significant digits, whatever the unit: lengths in metres are small.
  const int decimals = 2 - static_cast<int>(std::floor(portable::log10(size)));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // Trailing zeros beyond two decimals are dropped.
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

std::string printable_name(std::string_view name) {
  std::string text = escaped(name);
  return is_cut(text) ? text : escaped(text, longest_word);
}

std::string printable(std::string_view text) {
  std::string result = with_short_words(escaped(text));
  if (result.size() <= longest_message) return result;
  const std::size_t tail =
      boundary(result, result.size() - (longest_message - head_of_message - omitted.size() - 2));
  return fmt::format("{} {} {}", result.substr(0, boundary(result, head_of_message)), omitted,
                     result.substr(tail));
}

std::string quote(std::string_view found) {
  // Characters; chosen by hand.
  constexpr std::size_t longest = 40;
  if (found.empty()) return "the end of the file";
  std::string text = "\"";
  for (std::size_t count = 0; !found.empty(); ++count) {
    if (count == longest) return text + "...\"";
    const Character character = first_character(found);
    if (character.is_valid && !commands_terminal(character.code)) {
      text += found.substr(0, character.size);
    } else {
      text += '.';
    }
    found.remove_prefix(character.size);
  }
  return text + "\"";
}

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  // Lead bytes of two to four bytes, and the lowest code that needs that many.
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  std::uint32_t code = lead & (0xFFU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < least[size] || code > 0x10FFFF || is_surrogate) return {};
  return {code, size, true};
}

bool commands_terminal(std::uint32_t code) {
  const bool is_control = code < 0x20 || (code >= 0x7F && code <= 0x9F);
  const bool turns = code == 0x061C || code == 0x200E || code == 0x200F ||
                     (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return is_control || turns || code == 0x2028 || code == 0x2029 || code == 0xFEFF;
}

char lower_case(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = lower_case(letter);
  return lower;
}

bool same_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower_case(x) == lower_case(y); });
}

ShownUnit shown_unit(std::string_view unit) {
  constexpr double mm_per_m = 1000;
  if (unit == "m") return {mm_per_m, "mm"};
  return {1, unit.empty() ? "units" : std::string(unit)};
}

std::string measure_text(double value, std::string_view unit) {
  // Shorter lengths are shown in millimetres. Chosen by hand.
  constexpr double small_m = 0.1;
  const bool is_long = unit == "m" && std::fabs(value) >= small_m;
  const ShownUnit shown = is_long ? ShownUnit{1, "m"} : shown_unit(unit);
  return fmt::format("{} {}", figure(shown.factor * value), shown.name);
}

}  // namespace kinemend
