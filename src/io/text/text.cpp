// Counts lines, notes repairs, and splits text into words.
#include "io/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/text/number.hpp"
#include "kinemend/experimental/letter_case.hpp"

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

}  // namespace kinemend
