#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/bvh_document.hpp"
#include "kinemend/clip.hpp"

namespace kinemend {

/// Text under construction.
class TextBuffer {
 public:
  explicit TextBuffer(std::size_t expected) { text_.resize(expected); }

  void append(std::string_view piece) {
    make_room(piece.size());
    // Mostly the one space between two numbers.
    if (piece.size() == 1) {
      text_[used_] = piece[0];
    } else {
      piece.copy(text_.data() + used_, piece.size());
    }
    used_ += piece.size();
  }
  void append_fixed(double value, unsigned decimals, CommaStyle commas = CommaStyle::none);
  void append_shortest(double value);
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

/// Fewest decimals for which reading gives back the rate, at least six.
std::string frame_time_text(double frame_rate_hz);

/// How `append_motion` writes.
struct MotionStyle {
  std::string_view line_end = "\n";
  unsigned decimals = 6;
  std::string_view frame_time;
};

/// `MOTION` and all frames, one a line, joints in the given order; angles continue the frame
/// before. Errors: `usage` for values that are not finite.
void append_motion(TextBuffer& out, const Clip& clip, const std::vector<std::size_t>& joints,
                   const MotionStyle& style);

/// The document's own text with every changed sample replaced; the clip has the document's skeleton
/// and frame count, and its rate too where the file has no frame time.
std::string rewrite_bvh(const Clip& clip, const BvhDocument& document);

}  // namespace kinemend
