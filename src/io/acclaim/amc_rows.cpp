// Reads frames line by line, bones in any order, and finds a frame that is cut off.
#include "io/acclaim/amc_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "io/text/cut_text.hpp"
#include "io/text/number.hpp"

namespace kinemend {

namespace {

// Commas and parentheses are treated as white space.
bool is_blank(char c) { return c == ' ' || c == '\t' || c == ',' || c == '(' || c == ')'; }

// Thrown within a frame that the end of the file cut off.
struct CutFrame {};

bool ends_word(char c) { return is_space(c) || is_blank(c) || c == '#'; }

}  // namespace

AmcRows::AmcRows(const SourceText& text, std::size_t begin, const AmcLayout& layout,
                 const std::vector<std::uint8_t>& is_angle, double degrees_per_value)
    : text_(text),
      position_(text.bytes.data() + begin),
      end_(text.bytes.data() + text.bytes.size()),
      plain_places_(text.bytes.data(), end_),
      last_end_(position_),
      layout_(layout),
      is_angle_(is_angle),
      degrees_per_value_(degrees_per_value),
      data_begin_(position_) {
  for (std::size_t i = 0; i < layout.size(); ++i) index_of_.emplace(layout[i].name, i);
}

const char* AmcRows::skip_blanks(const char* p) const {
  while (p != end_ && is_blank(*p)) ++p;
  return p;
}

// Moves to the next word, across line ends and comments.
const char* AmcRows::skip_lines(const char* p) const {
  for (;;) {
    while (p != end_ && (is_space(*p) || is_blank(*p))) ++p;
    if (p == end_ || *p != '#') return p;
    p = std::find_if(p, end_, is_line_end);
  }
}

std::string_view AmcRows::word_at(const char* p) const {
  return {p, static_cast<std::size_t>(std::find_if(p, end_, ends_word) - p)};
}

bool AmcRows::read_frame_number() {
  const char* const p = skip_lines(position_);
  position_ = p;
  if (p == end_) return false;
  const std::string_view word = word_at(p);
  const NumberToken token = read_number(p, p + word.size());
  if (token.kind != TokenKind::number || token.end != p + word.size()) {
    const bool again = index_of_.find(word) != index_of_.end();
    fail(p, word, may_start_number(word),
         again ? fmt::format("the bone {} occurs twice in a frame", quote(word))
               : fmt::format("expected the number of a frame, found {}", quote(word)));
  }
  if (has_frame_number_ && token.value != frame_number_ + 1 && number_jumps_++ == 0) {
    first_number_jump_ = p;
  }
  if (!has_frame_number_) first_frame_number_ = token.value;
  frame_number_ = token.value;
  has_frame_number_ = true;
  position_ = p + word.size();
  const char* const rest = skip_blanks(position_);
  if (rest != end_ && !is_line_end(*rest) && *rest != '#') {
    throw text_.error_at(
        rest, fmt::format("expected only the number of a frame, found {}", quote(word_at(rest))));
  }
  return true;
}

bool AmcRows::starts_bone(const char* p, const std::string& name) const {
  const auto room = static_cast<std::size_t>(end_ - p);
  return room > name.size() && std::memcmp(p, name.data(), name.size()) == 0 &&
         ends_word(p[name.size()]);
}

bool AmcRows::next(double* values, TokenSpan* tokens) {
  const char* const last_end = last_end_;
  const std::size_t gaps = gaps_, number_jumps = number_jumps_;
  const std::size_t joins = joins_.size();
  const char* const begin = skip_lines(position_);
  try {
    if (!read_frame(values, tokens)) return false;
    if (last_end_ != end_ || !last_value_may_be_cut()) return true;
  } catch (const CutFrame&) {
  }
  // The cut frame is ignored.
  cut_frame_ = begin;
  position_ = end_;
  last_end_ = last_end;
  gaps_ = gaps;
  number_jumps_ = number_jumps;
  joins_.resize(joins);
  return false;
}

bool AmcRows::last_value_may_be_cut() const {
  return last_number_may_be_cut({data_begin_, static_cast<std::size_t>(end_ - data_begin_)},
                                CommaStyle::none, ' ', LikeLines::same_first_word);
}

// Throws an error at `word`, unless it may be the start of a longer word that was cut.
void AmcRows::fail(const char* p, std::string_view word, bool may_be_cut,
                   const std::string& message) const {
  if (may_be_cut && p + word.size() == end_) throw CutFrame();
  throw text_.error_at(p, message);
}

bool AmcRows::read_frame(double* values, TokenSpan* tokens) {
  if (!read_frame_number()) return false;
  std::size_t i = 0;
  for (; i < layout_.size(); ++i) {
    const char* const p = skip_lines(position_);
    if (!starts_bone(p, layout_[i].name)) break;
    read_bone(layout_[i], p, values, tokens);
  }
  if (i < layout_.size()) read_bones_in_any_order(i, values, tokens);
  if (degrees_per_value_ == 1) return true;
  for (std::size_t c = 0; c < is_angle_.size(); ++c) {
    if (is_angle_[c] != 0) values[c] *= degrees_per_value_;
  }
  return true;
}

// Reads the rest of a frame whose first bones were in the order of the layout.
void AmcRows::read_bones_in_any_order(std::size_t first, double* values, TokenSpan* tokens) {
  std::vector<bool> seen(layout_.size());
  std::fill(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(first), true);
  for (std::size_t count = first; count < layout_.size(); ++count) {
    const char* const p = skip_lines(position_);
    const std::size_t bone = bone_at(p, seen);
    seen[bone] = true;
    read_bone(layout_[bone], p, values, tokens);
  }
}

std::size_t AmcRows::bone_at(const char* p, const std::vector<bool>& seen) const {
  const std::string_view word = word_at(p);
  const auto found = index_of_.find(word);
  if (found == index_of_.end()) {
    if (word.empty() || read_number(p, p + word.size()).kind == TokenKind::number) {
      fail_missing(seen, p);
    }
    fail(p, word, true, fmt::format("the bone {} is not in the first frame", quote(word)));
  }
  if (seen[found->second]) {
    throw text_.error_at(p, fmt::format("the bone {} occurs twice in a frame", quote(word)));
  }
  return found->second;
}

void AmcRows::fail_missing(const std::vector<bool>& seen, const char* p) const {
  // If the last line is complete, the frame is damaged, not cut.
  if (p == end_ && !is_line_end(end_[-1])) throw CutFrame();
  const auto missing = std::find(seen.begin(), seen.end(), false) - seen.begin();
  throw text_.error_at(p, fmt::format("frame {:.0f} ends without the bone {}", frame_number_,
                                      quote(layout_[static_cast<std::size_t>(missing)].name)));
}

void AmcRows::read_bone(const AmcBone& bone, const char* p, double* values, TokenSpan* tokens) {
  const char* const line = p;
  p += bone.name.size();
  for (const std::size_t column : bone.columns) {
    p = *p == ' ' ? p + 1 : p;
    if (p != end_ && is_blank(*p)) p = skip_blanks(p);
    if (p == end_ || is_line_end(*p) || *p == '#') fail_value(bone, line, p);
    const char* const begin = p;
    const double value = read_value(p);
    if (column == AmcBone::no_column) continue;
    values[column] = value;
    if (tokens != nullptr) tokens[column] = {begin, p};
  }
  last_end_ = p;
  p = skip_blanks(p);
  if (p != end_ && !is_line_end(*p) && *p != '#') fail_value(bone, line, p);
  position_ = p;
}

double AmcRows::read_value(const char*& p) {
  PlainNumber plain;
  if (plain_places_.holds(p) && read_plain_number(p, plain) && is_space(p[plain.length]))
      [[likely]] {
    p += plain.length;
    most_decimals_ = std::max(most_decimals_, plain.decimals);
    return plain.value;
  }
  const std::string_view word = word_at(p);
  const NumberToken token = word.empty() ? NumberToken{} : read_sample(p, p + word.size());
  if (token.kind == TokenKind::text && numbers_in_word(word) > 1) return read_joined(p, word);
  const bool is_value = token.kind == TokenKind::number || token.kind == TokenKind::not_finite;
  if (!is_value || token.end != p + word.size()) {
    fail(p, word, may_start_number(word), fmt::format("expected a number, found {}", quote(word)));
  }
  if (token.kind == TokenKind::not_finite && gaps_++ == 0) first_gap_ = p;
  most_decimals_ = std::max(most_decimals_, token.decimals);
  p += word.size();
  return token.kind == TokenKind::number ? token.value : std::numeric_limits<double>::quiet_NaN();
}

// Reads the first of several numbers without a blank between them.
double AmcRows::read_joined(const char*& p, std::string_view word) {
  const char* const end = word.data() + word.size();
  const char* const next = second_number(p, end);
  const double value = read_sample(p, next).value;
  p = next;
  if (next != end) joins_.push_back(next);
  return value;
}

void AmcRows::fail_value(const AmcBone& bone, const char* line, const char* p) const {
  if (p == end_) throw CutFrame();
  std::size_t found = 0;
  for (p = line + bone.name.size(); (p = skip_blanks(p)) != end_;) {
    const std::string_view word = word_at(p);
    if (word.empty()) break;
    p += word.size();
    ++found;
  }
  throw text_.error_at(line, fmt::format("expected {} values of the bone {}, found {}",
                                         bone.columns.size(), quote(bone.name), found));
}

}  // namespace kinemend
