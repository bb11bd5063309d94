// Reads numbers by the fast path and any other text by the slow path, and finds the first line that
// is too short or too long.
#include "io/motion/motion_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinemend {

MotionRows::MotionRows(const char* begin, const char* end, CommaStyle commas)
    : end_(end), position_(begin), last_end_(begin), plain_places_(begin, end), commas_(commas) {}

const char* MotionRows::skip(const char* p) const {
  p = skip_space(p, end_);
  if (commas_ != CommaStyle::separator) return p;
  while (p != end_ && (is_space(*p) || *p == ',')) ++p;
  return p;
}

bool MotionRows::at_line_start() const { return std::any_of(last_end_, position_, is_line_end); }

// Reads the cases that `read_plain_number` rejects: exponents, many digits, NaN, comments, the last
// bytes. Returns false at the end or at text.
bool MotionRows::read_rare(const char*& p, NumberToken& token) {
  for (;;) {
    if (p == end_) return false;
    if (p < joined_until_) return read_joined(p, token);
    token = read_sample(p, end_, commas_);
    if (token.kind == TokenKind::text) return read_joined(p, token);
    if (token.kind == TokenKind::number) return true;
    if (token.kind == TokenKind::not_finite) {
      found_.gaps.add(p);
      return true;
    }
    found_.comments.add(p);
    p = skip(std::find_if(p, end_, is_line_end));
  }
}

// Reads the first of several numbers without a blank between them; returns false for any other
// text.
bool MotionRows::read_joined(const char* p, NumberToken& token) {
  if (p >= joined_until_) {
    if (numbers_in_word({p, static_cast<std::size_t>(token.end - p)}) < 2) return false;
    joined_until_ = token.end;
  }
  const char* const next = second_number(p, joined_until_);
  token = read_sample(p, next, commas_);
  if (token.kind == TokenKind::not_finite) found_.gaps.add(p);
  if (next != joined_until_) found_.joins.push_back(next);
  return true;
}

template <bool keep_tokens>
std::size_t MotionRows::read(double* values, std::size_t count, TokenSpan* tokens) {
  const char* p = skip(position_);
  const char* last_end = last_end_;
  unsigned most_decimals = found_.most_decimals;
  std::size_t i = 0;
  for (; i < count; ++i) {
    PlainNumber number;
    // A number ends with white space, not with any control character.
    if (plain_places_.holds(p) && read_plain_number(p, number) && is_space(p[number.length]))
        [[likely]] {
      last_end = p + number.length;
      if constexpr (keep_tokens) tokens[i] = {p, last_end};
      values[i] = number.value;
      most_decimals = std::max(most_decimals, number.decimals);
      // Digits, the point and the minus sign come after the comma.
      if (last_end[0] == ' ' && last_end[1] > ',') [[likely]] {
        p = last_end + 1;
        continue;
      }
    } else {
      const char* begin = p;
      NumberToken token;
      const bool found = read_rare(begin, token);
      p = begin;
      if (!found) break;
      last_end = token.end;
      if constexpr (keep_tokens) tokens[i] = {p, last_end};
      values[i] = token.value;
      most_decimals = std::max(most_decimals, token.decimals);
    }
    p = skip(last_end);
  }
  last_end_ = last_end;
  found_.most_decimals = most_decimals;
  position_ = p;
  return i;
}

std::size_t MotionRows::next(double* values, std::size_t count, TokenSpan* tokens) {
  return tokens == nullptr ? read<false>(values, count, nullptr)
                           : read<true>(values, count, tokens);
}

namespace {

struct Line {
  const char* begin = nullptr;
  std::size_t values = 0;
};

// Walks over the lines with values; blank lines and comments are skipped.
class ValueLines {
 public:
  ValueLines(const char* begin, const char* end, CommaStyle commas)
      : p_(begin), end_(end), commas_(commas) {}

  bool next(Line& line) {
    while (p_ != end_) {
      const char* const stop = std::find_if(p_, end_, is_line_end);
      line = {skip_space(p_, stop), 0};
      count_values(line, stop);
      p_ = stop == end_ ? end_ : stop + 1;
      if (line.values > 0) return true;
    }
    return false;
  }

 private:
  void count_values(Line& line, const char* stop) const {
    bool inside = false;
    for (const char* p = line.begin; p != stop; ++p) {
      const bool blank = is_space(*p) || (commas_ == CommaStyle::separator && *p == ',');
      if (!blank && !inside && (*p == '#' || (*p == '/' && p + 1 != stop && p[1] == '/'))) return;
      line.values += !blank && !inside ? values_in_word(p, stop) : 0;
      inside = !blank;
    }
  }

  std::size_t values_in_word(const char* p, const char* stop) const {
    const char* end = p;
    while (end != stop && !is_space(*end) && !(commas_ == CommaStyle::separator && *end == ','))
      ++end;
    return numbers_in_word({p, static_cast<std::size_t>(end - p)});
  }

  const char* p_;
  const char* end_;
  CommaStyle commas_;
};

// Finds the first line of the first group of lines that does not hold whole frames.
std::optional<LineFault> find_uneven_group(ValueLines lines, std::size_t channels) {
  Line line, first;
  std::size_t sum = 0;
  while (lines.next(line)) {
    if (sum == 0) {
      first = line;
    } else if (line.values == channels) {
      return LineFault{first.begin, channels, sum < channels ? sum : first.values};
    }
    sum = (sum + line.values) % channels == 0 ? 0 : sum + line.values;
  }
  if (sum == 0) return std::nullopt;
  return LineFault{first.begin, channels, sum < channels ? sum : first.values};
}

}  // namespace

std::string to_string(const LineFault& fault) {
  return fmt::format("expected {} channel values, found {}", fault.expected, fault.found);
}

std::optional<LineFault> find_line_fault(const char* begin, const char* end, CommaStyle commas,
                                         std::size_t channels,
                                         std::optional<std::size_t> declared_frames) {
  std::size_t lines = 0, even = 0, like_first = 0;
  Line line, first;
  for (ValueLines all(begin, end, commas); all.next(line); ++lines) {
    if (lines == 0) first = line;
    even += line.values == channels ? 1 : 0;
    like_first += line.values == first.values ? 1 : 0;
  }
  if (2 * even > lines) return find_uneven_group(ValueLines(begin, end, commas), channels);
  if (first.values != channels && 2 * like_first > lines && declared_frames == lines) {
    return LineFault{first.begin, channels, first.values};
  }
  return std::nullopt;
}

}  // namespace kinemend
