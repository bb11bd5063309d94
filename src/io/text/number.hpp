// Reads and writes numbers as text, correctly rounded and fast.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "base/portable.hpp"

namespace kinemend {

/// The value of a cell without a number.
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The meaning of a comma between digits in one part of a file.
enum class CommaStyle : std::uint8_t { none, decimal, separator };

enum class TokenKind : std::uint8_t {
  number,
  not_finite,  ///< nan, inf, 1.#IND and similar words, or a number beyond the range of a double
  comment,     ///< starts with # or //
  text,        ///< anything else
};

/// A token as `read_number` understands it.
struct NumberToken {
  TokenKind kind = TokenKind::text;
  double value = 0;
  const char* end = nullptr;
  unsigned decimals = 0;  ///< digits after the point of a number without exponent
};

/// Reads any number in the notation of the C locale, whatever the locale is, correctly rounded.
/// `begin` is the first byte of the token, which ends before white space (or before a comma that
/// separates); an empty token is `text`.
NumberToken read_number(const char* begin, const char* end, CommaStyle commas = CommaStyle::none);
inline NumberToken read_number(std::string_view word, CommaStyle commas = CommaStyle::none) {
  return read_number(word.data(), word.data() + word.size(), commas);
}

/// Reads a position or an angle: a value beyond 1e100, whose square may overflow, is `not_finite`.
NumberToken read_sample(const char* begin, const char* end, CommaStyle commas = CommaStyle::none);

/// Returns how many numbers a word holds, because some programs write no blank before a minus sign
/// (`0.0-7.5094748`). A sign after a digit or a point starts the next number; a sign after an
/// exponent mark (`1e-5`) does not. 1 for a word that does not consist of numbers, or that has no
/// point, like a date.
std::size_t numbers_in_word(std::string_view word);
/// Returns the start of the second number in such a word.
const char* second_number(const char* begin, const char* end);

/// Returns how to read the commas of `line` if it holds `expected` numbers; `none` if it has no
/// comma, or if both readings or neither are possible.
CommaStyle comma_style(std::string_view line, std::size_t expected);

inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }
inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
inline const char* skip_space(const char* p, const char* end) {
  while (p != end && is_space(*p)) ++p;
  return p;
}

/// One bit per byte, for the 16 bytes at an address.
struct ByteMasks {
  std::uint32_t blank = 0;  ///< control characters and the space
  std::uint32_t digit = 0;
  std::uint32_t dot = 0;
  friend bool operator==(const ByteMasks&, const ByteMasks&) = default;
};

namespace detail {

inline std::uint64_t load8(const char* p) {
  std::uint64_t bytes;
  std::memcpy(&bytes, p, sizeof bytes);
  return bytes;
}

// Returns the top bits of the eight bytes, the first byte in bit 0.
inline std::uint32_t top_bits(std::uint64_t bytes) {
  return static_cast<std::uint32_t>((((bytes >> 7) & 0x0101010101010101u) * 0x0102040810204080u) >>
                                    56);
}

// Sets the top bit of each byte whose seven low bits are at least `low`.
inline std::uint64_t at_least(std::uint64_t seven_bits, unsigned low) {
  return seven_bits + 0x0101010101010101u * (0x80 - low);
}

template <char also_blank>
inline ByteMasks byte_masks_of_eight(const char* p) {
  constexpr std::uint64_t tops = 0x8080808080808080u;
  const std::uint64_t bytes = load8(p), ascii = ~bytes & tops, low = bytes & ~tops;
  const std::uint64_t digits = at_least(low, '0') & ~at_least(low, '9' + 1) & ascii;
  const std::uint64_t dots = at_least(low, '.') & ~at_least(low, '.' + 1) & ascii;
  std::uint64_t blanks = ~at_least(low, ' ' + 1) & ascii;
  if constexpr (also_blank > ' ') {
    blanks |= at_least(low, also_blank) & ~at_least(low, also_blank + 1) & ascii;
  }
  return {top_bits(blanks), top_bits(digits), top_bits(dots)};
}

/// `byte_masks` for processors without SSE2.
template <char also_blank = ' '>
inline ByteMasks byte_masks_portable(const char* p) {
  const ByteMasks first = byte_masks_of_eight<also_blank>(p);
  const ByteMasks second = byte_masks_of_eight<also_blank>(p + 8);
  return {first.blank | second.blank << 8, first.digit | second.digit << 8,
          first.dot | second.dot << 8};
}

/// `also_blank`: a separator that is treated as a blank.
template <char also_blank = ' '>
inline ByteMasks byte_masks(const char* p) {
#if defined(__SSE2__)
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  const auto bits = [](__m128i mask) {
    return static_cast<std::uint32_t>(_mm_movemask_epi8(mask));
  };
  const auto at_most = [](__m128i value, char limit) {
    return _mm_cmpeq_epi8(_mm_min_epu8(value, _mm_set1_epi8(limit)), value);
  };
  std::uint32_t blanks = bits(at_most(bytes, ' '));
  if constexpr (also_blank > ' ') blanks |= bits(_mm_cmpeq_epi8(bytes, _mm_set1_epi8(also_blank)));
  return {blanks, bits(at_most(_mm_sub_epi8(bytes, _mm_set1_epi8('0')), 9)),
          bits(_mm_cmpeq_epi8(bytes, _mm_set1_epi8('.')))};
#else
  return byte_masks_portable<also_blank>(p);
#endif
}

inline constexpr std::uint64_t integer_powers[] = {1,      10,      100,      1000,     10000,
                                                   100000, 1000000, 10000000, 100000000};
inline constexpr double powers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};

// Masks that keep the digits' values in the last `count` of eight bytes (the highest bytes, read
// little-endian).
inline constexpr std::uint64_t last_digits[] = {
    0,
    0x0F00000000000000u,
    0x0F0F000000000000u,
    0x0F0F0F0000000000u,
    0x0F0F0F0F00000000u,
    0x0F0F0F0F0F000000u,
    0x0F0F0F0F0F0F0000u,
    0x0F0F0F0F0F0F0F00u,
    0x0F0F0F0F0F0F0F0Fu,
};

struct DigitGroups {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  friend bool operator==(const DigitGroups&, const DigitGroups&) = default;
};

// Joins two groups of eight digit values into numbers: pairs, then fours, then all in one register.
inline DigitGroups join_digits_portable(std::uint64_t first, std::uint64_t second) {
  const auto join = [](std::uint64_t digits) {
    digits = (digits * 10 + (digits >> 8)) & 0x00FF00FF00FF00FFu;
    digits = (digits * 100 + (digits >> 16)) & 0x0000FFFF0000FFFFu;
    return static_cast<std::uint32_t>(digits * 10000 + (digits >> 32));
  };
  return {join(first), join(second)};
}

inline DigitGroups join_digits(std::uint64_t first, std::uint64_t second) {
#if defined(__SSE2__)
  const __m128i digits =
      _mm_set_epi64x(static_cast<std::int64_t>(second), static_cast<std::int64_t>(first));
  const __m128i tens =
      _mm_and_si128(_mm_mullo_epi16(digits, _mm_set1_epi16(10)), _mm_set1_epi16(0xFF));
  const __m128i pairs = _mm_add_epi16(tens, _mm_srli_epi16(digits, 8));
  const __m128i fours = _mm_madd_epi16(pairs, _mm_set1_epi32(1 << 16 | 100));
  const __m128i eights =
      _mm_madd_epi16(_mm_packs_epi32(fours, fours), _mm_set1_epi32(1 << 16 | 10000));
  const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(eights));
  return {static_cast<std::uint32_t>(both), static_cast<std::uint32_t>(both >> 32)};
#else
  return join_digits_portable(first, second);
#endif
}

}  // namespace detail

/// Bytes that must be readable before and after the start of a token for `read_plain_number`.
inline constexpr std::ptrdiff_t plain_number_lead = 8;
inline constexpr std::ptrdiff_t plain_number_reach = 32;

/// The places of a text with enough readable bytes around them.
class PlainPlaces {
 public:
  PlainPlaces(const char* begin, const char* end)
      : first_(begin + std::min<std::ptrdiff_t>(plain_number_lead, end - begin)),
        count_(std::max<std::ptrdiff_t>(
            0, end - begin - plain_number_lead - plain_number_reach + 1)) {}
  bool holds(const char* p) const {
    return static_cast<std::size_t>(p - first_) < static_cast<std::size_t>(count_);
  }

 private:
  const char* first_;
  std::ptrdiff_t count_;
};

struct PlainNumber {
  double value = 0;
  unsigned length = 0;
  unsigned decimals = 0;
};

/// Reads the common case without branches that depend on the token's length: an optional minus
/// sign, up to eight digits, a point, up to eight digits, at most 15 digits. Both the digits and
/// the power of ten are exact doubles, so the quotient is correctly rounded. The token ends before
/// white space or `separator`. False for any other token; little-endian processors only.
template <char separator = ' '>
inline bool read_plain_number(const char* p, PlainNumber& number) {
  if constexpr (std::endian::native != std::endian::little) return false;
  const ByteMasks masks = detail::byte_masks<separator>(p);
  const auto length = static_cast<unsigned>(std::countr_zero(masks.blank | 0x10000u));
  const std::uint32_t negative = *p == '-' ? 1 : 0;
  const std::uint32_t beyond = 1u << length, whole = beyond - 1;
  const std::uint32_t dots = masks.dot & whole;
  const auto dot = static_cast<unsigned>(std::countr_zero(dots | beyond));
  const unsigned before = dot - negative, after = length - dot - (dots != 0 ? 1 : 0);
  const bool plain = ((masks.digit | dots | negative) & whole) == whole && (dots & (dots - 1)) == 0;
  if (!plain || before > 8 || after > 8 || before + after == 0 || length == 16) return false;
  // Each part is loaded so that it ends with the eight bytes.
  const std::uint64_t integer = detail::load8(p + dot - 8) & detail::last_digits[before];
  const std::uint64_t fraction = detail::load8(p + length - 8) & detail::last_digits[after];
  const detail::DigitGroups parts = detail::join_digits(integer, fraction);
  const auto mantissa =
      static_cast<std::int64_t>(parts.first * detail::integer_powers[after] + parts.second);
  const double value = static_cast<double>(mantissa) / detail::powers[after];
  number.value =
      bits_as<double>(bits_as<std::uint64_t>(value) | static_cast<std::uint64_t>(negative) << 63);
  number.length = length;
  number.decimals = after;
  return true;
}

/// Buffer size that `write_fixed` may need.
inline constexpr std::size_t fixed_number_room = 352;

/// Writes a finite number with `decimals` decimals (0 to 9), never with an exponent and never as
/// minus zero, correctly rounded. Returns the end of the written text.
char* write_fixed(char* out, double value, unsigned decimals);

/// Writes the shortest digits that read back as the same number, without exponent.
char* write_shortest(char* out, double value);

}  // namespace kinemend
