// Reads the numbers that the fast path cannot, and writes numbers with fixed or fewest digits.
#include "io/text/number.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/text/fixed_digits.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

bool starts_with_word(std::string_view text, std::string_view word) {
  return text.size() >= word.size() &&
         std::equal(word.begin(), word.end(), text.begin(),
                    [](char w, char t) { return w == lower_case(t); });
}

// Recognises "nan", "-nan(ind)", "Infinity", and "1.#QNAN" as older C libraries print it.
bool names_no_number(std::string_view token) {
  if (!token.empty() && (token.front() == '-' || token.front() == '+')) token.remove_prefix(1);
  return starts_with_word(token, "nan") || starts_with_word(token, "inf") ||
         starts_with_word(token, "1.#");
}

unsigned decimals_of(std::string_view token) {
  const std::size_t dot = token.find('.');
  if (dot == token.npos || token.find_first_of("eE") != token.npos) return 0;
  return static_cast<unsigned>(token.size() - dot - 1);
}

NumberToken parse(std::string_view token) {
  NumberToken result;
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-';
  const char* first = token.data() + (plus ? 1 : 0);
  const char* last = token.data() + token.size();
  const auto parsed = fast_float::from_chars(first, last, result.value);
  const bool whole = parsed.ptr == last && first != last;
  if (names_no_number(token) || (whole && !std::isfinite(result.value))) {
    result.kind = TokenKind::not_finite;
    result.value = std::numeric_limits<double>::quiet_NaN();
  } else if (whole) {
    result.kind = TokenKind::number;
    result.decimals = decimals_of(token);
  }
  return result;
}

}  // namespace

NumberToken read_number(const char* begin, const char* end, CommaStyle commas) {
  const bool separates = commas == CommaStyle::separator;
  const char* last = begin;
  while (last != end && !is_space(*last) && !(separates && *last == ',')) ++last;
  const std::string_view token(begin, static_cast<std::size_t>(last - begin));
  NumberToken result;
  if (token.substr(0, 1) == "#" || token.substr(0, 2) == "//") {
    result.kind = TokenKind::comment;
  } else if (commas == CommaStyle::decimal && token.find(',') != token.npos) {
    std::array<char, 64> copy{};
    if (token.size() <= copy.size() && token.find('.') == token.npos) {
      std::replace_copy(token.begin(), token.end(), copy.begin(), ',', '.');
      result = parse({copy.data(), token.size()});
    }
  } else {
    result = parse(token);
  }
  result.end = last;
  return result;
}

NumberToken read_sample(const char* begin, const char* end, CommaStyle commas) {
  // Above this, sums and products may overflow; chosen by hand.
  constexpr double largest = 1e100;
  NumberToken result = read_number(begin, end, commas);
  if (result.kind == TokenKind::number && std::fabs(result.value) > largest) {
    result.kind = TokenKind::not_finite;
    result.value = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

const char* second_number(const char* begin, const char* end) {
  for (const char* p = begin; p != end && p + 1 != end; ++p) {
    const bool ends_number = (*p >= '0' && *p <= '9') || *p == '.';
    if (ends_number && (p[1] == '-' || p[1] == '+')) return p + 1;
  }
  return end;
}

std::size_t numbers_in_word(std::string_view word) {
  if (word.find('.') == word.npos) return 1;
  std::size_t count = 0;
  const char* const end = word.data() + word.size();
  for (const char* p = word.data(); p != end; ++count) {
    const char* const next = second_number(p, end);
    const NumberToken number = read_number(p, next);
    if (number.kind != TokenKind::number || number.end != next) return 1;
    p = next;
  }
  return std::max<std::size_t>(count, 1);
}

CommaStyle comma_style(std::string_view line, std::size_t expected) {
  if (line.find(',') == line.npos) return CommaStyle::none;
  std::size_t by_space = 0, by_both = 0;
  bool in_token = false, in_part = false;
  for (const char c : line) {
    const bool inside = !is_space(c), part = inside && c != ',';
    by_space += inside && !in_token ? 1 : 0;
    by_both += part && !in_part ? 1 : 0;
    in_token = inside;
    in_part = part;
  }
  const bool separator = by_both == expected;
  const bool decimal = by_space == expected && line.find('.') == line.npos;
  if (separator == decimal) return CommaStyle::none;
  return separator ? CommaStyle::separator : CommaStyle::decimal;
}

namespace {

constexpr std::array<double, 10> scales{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr std::array<std::uint32_t, 10> integer_scales{
    1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};

constexpr auto digit_pairs = [] {
  std::array<char, 200> pairs{};
  for (std::size_t i = 0; i < 100; ++i) {
    pairs[2 * i] = static_cast<char>('0' + i / 10);
    pairs[2 * i + 1] = static_cast<char>('0' + i % 10);
  }
  return pairs;
}();

// The texts of 0 to 999 without leading zeros, with the length in the fourth byte. Angles are not
// larger.
constexpr auto small_integers = [] {
  std::array<char, 4000> texts{};
  for (std::size_t i = 0; i < 1000; ++i) {
    char* text = &texts[4 * i];
    std::size_t length = 0;
    if (i >= 100) text[length++] = static_cast<char>('0' + i / 100);
    if (i >= 10) text[length++] = static_cast<char>('0' + i / 10 % 10);
    text[length++] = static_cast<char>('0' + i % 10);
    text[3] = static_cast<char>(length);
  }
  return texts;
}();

char* write_integer(char* out, std::uint64_t value) {
  if (value >= 1000) return std::to_chars(out, out + fixed_number_room, value).ptr;
  const char* text = &small_integers[4 * static_cast<std::size_t>(value)];
  std::memcpy(out, text, 4);
  return out + text[3];
}

// Writes exactly `count` digits.
char* write_digits(char* out, std::uint32_t value, unsigned count) {
  char* p = out + count;
  for (; p - out >= 2; value /= 100) {
    p -= 2;
    std::memcpy(p, &digit_pairs[2 * (value % 100)], 2);
  }
  if (p != out) *out = static_cast<char>('0' + value);
  return out + count;
}

char* write_with_library(char* out, double value, unsigned decimals) {
  char* end = write_decimals(out, out + fixed_number_room, value, decimals);
  const bool zero = std::all_of(out, end, [](char c) { return c == '-' || c == '0' || c == '.'; });
  if (zero && *out == '-') {
    std::memmove(out, out + 1, static_cast<std::size_t>(end - out - 1));
    --end;
  }
  return end;
}

}  // namespace

char* write_fixed(char* out, double value, unsigned decimals) {
  const double scaled = std::fabs(value) * scales[decimals];
  if (!(scaled < 1e15)) return write_with_library(out, value, decimals);
  auto integer = static_cast<std::uint64_t>(scaled);
  // The product has an error of at most half a unit in its last place, so close to a tie the exact
  // method decides.
  const double beyond_tie = scaled - static_cast<double>(integer) - 0.5;
  if (std::fabs(beyond_tie) <= scaled * 0x1p-52) return write_with_library(out, value, decimals);
  integer += beyond_tie > 0 ? 1 : 0;
  if (value < 0 && integer > 0) *out++ = '-';
  const std::uint32_t scale = integer_scales[decimals];
  const std::uint64_t whole = integer / scale;
  out = write_integer(out, whole);
  if (decimals == 0) return out;
  *out++ = '.';
  return write_digits(out, static_cast<std::uint32_t>(integer - whole * scale), decimals);
}

char* write_shortest(char* out, double value) {
  if (value == 0) value = 0;
  return write_round_trip(out, out + fixed_number_room, value);
}

}  // namespace kinemend
