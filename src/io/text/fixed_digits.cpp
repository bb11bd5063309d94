// Writes with the standard library, or else from the shortest digits that fmt finds.
#include "io/text/fixed_digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>

namespace kinemend {

namespace {

char* put(char* out, const char* end, std::string_view text) {
  const auto room = static_cast<std::size_t>(end - out);
  return std::copy_n(text.data(), std::min(room, text.size()), out);
}

// Converts "1.25e-07" to "0.000000125".
std::string in_fixed_notation(std::string_view shortest) {
  const std::size_t mark = shortest.find('e');
  if (mark == shortest.npos) return std::string(shortest);
  std::string text;
  if (shortest.front() == '-') text = "-";
  std::string digits;
  for (const char c : shortest.substr(0, mark)) {
    if (c >= '0' && c <= '9') digits += c;
  }
  int exponent = 0;
  const char* first = shortest.data() + mark + 1;
  if (*first == '+') ++first;
  std::from_chars(first, shortest.data() + shortest.size(), exponent);
  if (exponent < 0)
    return text + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (digits.size() <= whole) return text + digits + std::string(whole - digits.size(), '0');
  return text + digits.substr(0, whole) + "." + digits.substr(whole);
}

template <class Real>
char* write_shortest_digits(char* out, char* end, Real value) {
  // Every number this large is whole, and the library writes all of its digits.
  const auto whole_from = std::ldexp(Real{1}, std::numeric_limits<Real>::digits);
  if (std::isfinite(value) && std::fabs(value) >= whole_from)
    return write_decimals_anywhere(out, end, static_cast<double>(value), 0);
  std::string text = in_fixed_notation(fmt::format("{}", value));
  // Some versions of fmt write 1.0 for 1.
  if (text.size() > 2 && text.ends_with(".0")) text.resize(text.size() - 2);
  return put(out, end, text);
}

}  // namespace

// The library of LLVM writes numbers with a point from version 14 on.
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000
char* write_decimals(char* out, char* end, double value, unsigned decimals) {
  return write_decimals_anywhere(out, end, value, decimals);
}
char* write_round_trip(char* out, char* end, double value) {
  return write_round_trip_anywhere(out, end, value);
}
char* write_round_trip(char* out, char* end, float value) {
  return write_round_trip_anywhere(out, end, value);
}
#else
char* write_decimals(char* out, char* end, double value, unsigned decimals) {
  return std::to_chars(out, end, value, std::chars_format::fixed, static_cast<int>(decimals)).ptr;
}
char* write_round_trip(char* out, char* end, double value) {
  return std::to_chars(out, end, value, std::chars_format::fixed).ptr;
}
char* write_round_trip(char* out, char* end, float value) {
  return std::to_chars(out, end, value, std::chars_format::fixed).ptr;
}
#endif

char* write_decimals_anywhere(char* out, char* end, double value, unsigned decimals) {
  constexpr std::size_t longest = 400;  // 309 digits, a sign, a point and the decimals
  std::array<char, longest> text;
  const int size =
      std::snprintf(text.data(), text.size(), "%.*f", static_cast<int>(decimals), value);
  return put(out, end, {text.data(), std::min(longest - 1, static_cast<std::size_t>(size))});
}
char* write_round_trip_anywhere(char* out, char* end, double value) {
  return write_shortest_digits(out, end, value);
}
char* write_round_trip_anywhere(char* out, char* end, float value) {
  return write_shortest_digits(out, end, value);
}

}  // namespace kinemend
