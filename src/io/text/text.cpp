// Counts lines, notes repairs, splits text into words, compares the digits of a file's last number
// with those of the lines before it, and appends numbers to a text.
#include "io/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/text/number.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

bool is_brace(char c) { return c == '{' || c == '}'; }

}  // namespace

std::size_t line_at(std::string_view text, std::size_t offset) {
  offset = std::min(offset, text.size());
  std::size_t line = 1;
  for (std::size_t i = 0; i < offset; ++i) {
    const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    line += is_line_end(text[i]) && !pair ? 1 : 0;
  }
  return line;
}

std::string_view line_ending_of(std::string_view text) {
  const std::size_t end = text.find_first_of("\r\n");
  if (end == text.npos || text[end] == '\n') return "\n";
  return text.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
}

bool equal_ignoring_case(std::string_view a, std::string_view b) { return same_but_for_case(a, b); }

Error SourceText::error_at(std::size_t offset, std::string_view message) const {
  return Error::at_line(name, line_at(bytes, offset), message);
}

void note_repair(const SourceText& text, Diagnostics& diagnostics, std::string_view kind,
                 std::size_t offset, std::string_view message, std::size_t count) {
  const std::size_t line = diagnostics.count(kind) == 0 ? line_at(text.bytes, offset) : 0;
  if (text.strict) {
    throw Error(ErrorKind::quality_limit, fmt::format("{}:{}: {}", text.name, line, message));
  }
  for (std::size_t i = 0; i < count; ++i) diagnostics.add(kind, message, line);
}

std::size_t TextScanner::line_end(std::size_t from) const {
  while (from < bytes_.size() && !is_line_end(bytes_[from])) ++from;
  return from;
}

void TextScanner::skip_blanks() {
  for (;;) {
    while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
    const std::string_view rest = bytes_.substr(position_, 2);
    if (rest.substr(0, 1) != "#" && rest != "//") return;
    if (comments_++ == 0) first_comment_ = position_;
    position_ = line_end(position_);
  }
}

std::string_view TextScanner::peek() {
  skip_blanks();
  std::size_t end = position_;
  if (end < bytes_.size() && is_brace(bytes_[end])) return bytes_.substr(end, 1);
  while (end < bytes_.size() && !is_space(bytes_[end]) && !is_brace(bytes_[end])) ++end;
  return bytes_.substr(position_, end - position_);
}

std::string_view TextScanner::next() {
  const std::string_view word = peek();
  position_ += word.size();
  return word;
}

bool TextScanner::accept(std::string_view word) {
  if (!equal_ignoring_case(peek(), word)) return false;
  next();
  return true;
}

std::string_view TextScanner::rest_of_line() const {
  std::size_t end = position_;
  while (end < bytes_.size() && !is_line_end(bytes_[end]) && !is_brace(bytes_[end])) ++end;
  return bytes_.substr(position_, end - position_);
}

std::string_view TextScanner::name() {
  while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
  std::string_view line = rest_of_line();
  position_ += line.size();
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  return line;
}

namespace {

// Chosen by hand, not swept.
constexpr std::size_t most_lines_compared = 100, least_lines_compared = 3;
// Larger, because lines of other bones lie between the lines of one bone.
constexpr std::size_t most_lines_passed = 20000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view first_word(std::string_view line) {
  return line.substr(0, std::find_if(line.begin(), line.end(), is_space) - line.begin());
}

// Returns the number of digits after the point of the last number of a line; empty if it is not a
// plain number.
std::optional<std::size_t> last_decimals(std::string_view line, CommaStyle commas, char separator) {
  std::size_t begin = line.size();
  while (begin > 0 && !is_space(line[begin - 1]) && line[begin - 1] != separator &&
         !(commas == CommaStyle::separator && line[begin - 1] == ','))
    --begin;
  const std::string_view word = line.substr(begin);
  std::size_t digits = 0;
  while (digits < word.size() && is_digit(word[word.size() - 1 - digits])) ++digits;
  if (word.find_first_of("eE") != word.npos || word.empty()) return std::nullopt;
  const std::string_view lead = word.substr(0, word.size() - digits);
  if (lead.empty() || lead == "-" || lead == "+") return 0;
  const bool has_point =
      lead.back() == '.' || (commas == CommaStyle::decimal && lead.back() == ',');
  return has_point ? std::optional<std::size_t>(digits) : std::nullopt;
}

// Returns the line before the line that starts at `begin`, and moves `begin` to it.
std::string_view line_before(std::string_view text, std::size_t& begin) {
  std::size_t end = begin;
  while (end > 0 && is_space(text[end - 1])) --end;
  begin = end;
  while (begin > 0 && !is_line_end(text[begin - 1])) --begin;
  return text.substr(begin, end - begin);
}

}  // namespace

bool may_start_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("+-.,0123456789eE") == word.npos &&
         word.front() != 'e' && word.front() != 'E';
}

bool last_number_may_be_cut(std::string_view rows, CommaStyle commas, char separator,
                            LikeLines like) {
  if (rows.empty() || is_space(rows.back()) || rows.back() == separator) return false;
  std::size_t begin = rows.size();
  const std::string_view last = line_before(rows, begin);
  const auto decimals = last_decimals(last, commas, separator);
  if (!decimals) return false;
  std::size_t compared = 0;
  for (std::size_t passed = 0; begin > 0 && compared < most_lines_compared; ++passed) {
    if (passed == most_lines_passed) break;
    const std::string_view line = line_before(rows, begin);
    if (like == LikeLines::same_first_word && first_word(line) != first_word(last)) continue;
    const auto others = last_decimals(line, commas, separator);
    if (!others) continue;
    if (*others <= *decimals) return false;
    ++compared;
  }
  return compared >= least_lines_compared;
}

namespace {

// Outputs never contain NaN or infinity.
void check_finite(double value) {
  if (!std::isfinite(value)) throw Error(ErrorKind::usage, "a value to write is not finite");
}

}  // namespace

void TextBuffer::append_fixed(double value, unsigned decimals, CommaStyle commas) {
  check_finite(value);
  make_room(fixed_number_room);
  char* const begin = text_.data() + used_;
  char* const end = write_fixed(begin, value, decimals);
  if (commas == CommaStyle::decimal) std::replace(begin, end, '.', ',');
  used_ += static_cast<std::size_t>(end - begin);
}

void TextBuffer::append_shortest(double value, CommaStyle commas) {
  check_finite(value);
  make_room(fixed_number_room);
  char* const begin = text_.data() + used_;
  char* const end = write_shortest(begin, value);
  if (commas == CommaStyle::decimal) std::replace(begin, end, '.', ',');
  used_ += static_cast<std::size_t>(end - begin);
}

}  // namespace kinemend
