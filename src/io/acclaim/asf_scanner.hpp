// Splits the text of an ASF file into words.
#pragma once

#include <cstddef>
#include <string_view>

#include "io/text/number.hpp"

namespace kinemend {

/// Walks over the words of an ASF file: white space, commas and parentheses separate them, and #
/// starts a comment.
class AsfScanner {
 public:
  explicit AsfScanner(std::string_view bytes, std::size_t position = 0)
      : bytes_(bytes), position_(position) {}

  /// Returns the next word, empty at the end, without moving past it.
  std::string_view peek() {
    while (position_ < bytes_.size()) {
      const char c = bytes_[position_];
      if (c == '#') {
        skip_line();
      } else if (is_blank(c)) {
        ++position_;
      } else {
        break;
      }
    }
    std::size_t end = position_;
    while (end < bytes_.size() && !is_blank(bytes_[end]) && bytes_[end] != '#') ++end;
    return bytes_.substr(position_, end - position_);
  }
  /// Returns the next word and moves past it.
  std::string_view next() {
    const std::string_view word = peek();
    position_ += word.size();
    return word;
  }
  /// Returns the next word of this line, or empty, and moves past it.
  std::string_view next_in_line() {
    while (position_ < bytes_.size() && is_blank(bytes_[position_]) &&
           !is_line_end(bytes_[position_])) {
      ++position_;
    }
    const bool more =
        position_ < bytes_.size() && !is_line_end(bytes_[position_]) && bytes_[position_] != '#';
    return more ? next() : std::string_view{};
  }
  void skip_line() {
    while (position_ < bytes_.size() && !is_line_end(bytes_[position_])) ++position_;
  }

  /// Returns the place of the next word, after a call of `peek`.
  std::size_t position() const { return position_; }

 private:
  static bool is_blank(char c) { return is_space(c) || c == ',' || c == '(' || c == ')'; }

  std::string_view bytes_;
  std::size_t position_;
};

}  // namespace kinemend
