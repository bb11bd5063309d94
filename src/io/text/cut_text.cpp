// Compares the digits of the last number with those of the lines before it.
#include "io/text/cut_text.hpp"

#include <algorithm>
#include <optional>

namespace kinemend {

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

}  // namespace kinemend
