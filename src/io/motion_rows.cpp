#include "io/motion_rows.hpp"

#include <algorithm>

namespace kinemend {

MotionRows::MotionRows(const char* begin, const char* end, CommaStyle commas)
    : position_(begin), end_(end), last_end_(begin), commas_(commas) {}

const char* MotionRows::skip(const char* p) const {
  p = skip_space(p, end_);
  if (commas_ != CommaStyle::separator) return p;
  while (p != end_ && (is_space(*p) || *p == ',')) ++p;
  return p;
}

bool MotionRows::at_line_start() const { return std::any_of(last_end_, position_, is_line_end); }

// What `read_plain_number` leaves: exponents, many digits, NaN, comments, the last bytes. False at
// the end or at text.
bool MotionRows::read_rare(const char*& p, NumberToken& token) {
  for (;;) {
    if (p == end_) return false;
    token = read_number(p, end_, commas_);
    if (token.kind == TokenKind::text) return false;
    if (token.kind == TokenKind::number) return true;
    if (token.kind == TokenKind::not_finite) {
      if (gaps_++ == 0) first_gap_ = p;
      return true;
    }
    if (comments_++ == 0) first_comment_ = p;
    p = skip(std::find_if(p, end_, is_line_end));
  }
}

template <bool keep_tokens>
std::size_t MotionRows::read(double* values, std::size_t count, TokenSpan* tokens) {
  const char* p = skip(position_);
  const char* const end = end_;
  unsigned most_decimals = most_decimals_;
  std::size_t i = 0;
  for (; i < count; ++i) {
    NumberToken token;
    const bool plain = end - p >= plain_number_reach && read_plain_number(p, token);
    if (!plain && !read_rare(p, token)) break;
    values[i] = token.value;
    most_decimals = std::max(most_decimals, token.decimals);
    if constexpr (keep_tokens) tokens[i] = {p, token.end};
    p = token.end;
    last_end_ = p;
    const bool single_space = plain && p[0] == ' ' && p[1] > ' ';
    p = single_space ? p + 1 : skip(p);
  }
  most_decimals_ = most_decimals;
  position_ = p;
  return i;
}

std::size_t MotionRows::next(double* values, std::size_t count, TokenSpan* tokens) {
  return tokens == nullptr ? read<false>(values, count, nullptr)
                           : read<true>(values, count, tokens);
}

}  // namespace kinemend
