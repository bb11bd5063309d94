// Tests of half-precision numbers, against Python's struct module and the bits themselves.
#include "nn/half.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/csv.hpp"

namespace kinemend {
namespace {

// tools/reference/tensors.py wrote the numbers and bits.
TEST(Half, RoundsAsPythonsStructDoes) {
  const auto rows = test::read_csv("tensors/halves.csv");
  ASSERT_GT(rows.size(), 2000u);
  for (const auto& row : rows) {
    const double value = std::strtod(row[0].c_str(), nullptr);
    const std::uint16_t half = to_half(value);
    if (row[1] == "overflow") {
      EXPECT_TRUE(std::isinf(from_half(half))) << row[0];
      EXPECT_EQ(std::signbit(from_half(half)), std::signbit(value)) << row[0];
    } else {
      EXPECT_EQ(half, std::strtoul(row[1].c_str(), nullptr, 16)) << row[0];
    }
  }
}

TEST(Half, ReadsEveryHalfAsTheNumberThatItsBitsMake) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const double sign = bits >= 0x8000 ? -1 : 1;
    const int exponent = static_cast<int>((bits >> 10) & 31);
    const double mantissa = bits & 1023;
    const double value = from_half(static_cast<std::uint16_t>(bits));
    if (exponent == 31) {
      ASSERT_EQ(std::isnan(value), mantissa != 0) << bits;
      ASSERT_FALSE(std::isfinite(value)) << bits;
      continue;
    }
    const double expected =
        exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    ASSERT_EQ(value, sign * expected) << bits;
    ASSERT_EQ(std::signbit(value), sign < 0) << bits;
    ASSERT_EQ(to_half(value), bits);
  }
}

}  // namespace
}  // namespace kinemend
