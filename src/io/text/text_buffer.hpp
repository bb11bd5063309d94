// A text to which writers append words and numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/text/number.hpp"

namespace kinemend {

/// Text under construction.
class TextBuffer {
 public:
  explicit TextBuffer(std::size_t expected) { text_.resize(expected); }

  void append(std::string_view piece) {
    make_room(piece.size());
    // The common case is one space between two numbers.
    if (piece.size() == 1) {
      text_[used_] = piece[0];
    } else {
      piece.copy(text_.data() + used_, piece.size());
    }
    used_ += piece.size();
  }
  void append_fixed(double value, unsigned decimals, CommaStyle commas = CommaStyle::none);
  void append_shortest(double value, CommaStyle commas = CommaStyle::none);
  std::string take() && {
    text_.resize(used_);
    return std::move(text_);
  }

 private:
  void make_room(std::size_t count) {
    if (text_.size() - used_ < count) text_.resize(text_.size() + text_.size() / 2 + count);
  }

  std::string text_;
  std::size_t used_ = 0;
};

}  // namespace kinemend
