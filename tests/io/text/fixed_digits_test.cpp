// The project's digit writer agrees with that of the standard library.
#include "io/text/fixed_digits.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace kinemend {
namespace {

template <class Write>
std::string text_of(const Write& write) {
  std::array<char, 352> room;
  return {room.data(), write(room.data(), room.data() + room.size())};
}

template <class Real>
void expect_same(Real value) {
  EXPECT_EQ(
      text_of([&](char* out, char* end) { return write_round_trip_anywhere(out, end, value); }),
      text_of([&](char* out, char* end) { return write_round_trip(out, end, value); }));
}

TEST(FixedDigits, AgreeWithTheLibraryOnKnownValues) {
  for (const double value :
       {0.0, -0.0, 1.0, -1.5, 0.1, 1e-7, 1.25e-7, 123456.789, 1e15, 1e16, 1e17, 9007199254740993.0,
        1e22, 1e23, 1.7976931348623157e308, 5e-324, 2.2250738585072014e-308}) {
    expect_same(value);
    expect_same(static_cast<float>(value));
  }
}

TEST(FixedDigits, AgreeWithTheLibraryOnRandomValues) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<double>(random());
    const auto single = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isfinite(value)) expect_same(value);
    if (std::isfinite(single)) expect_same(single);
    const double usual = std::ldexp(static_cast<double>(random() >> 11), -40);
    expect_same(usual);
    const auto decimals = static_cast<unsigned>(random() % 10);
    EXPECT_EQ(
        text_of([&](char* out, char* end) {
          return write_decimals_anywhere(out, end, usual, decimals);
        }),
        text_of([&](char* out, char* end) { return write_decimals(out, end, usual, decimals); }));
  }
}

}  // namespace
}  // namespace kinemend
