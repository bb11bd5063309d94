// 2 pi to 106 bits, and rounding of numbers to whole steps and to upper bits.
#pragma once

#include <cstdint>

#include "base/double_double.hpp"

namespace kinemend::portable {

inline constexpr DoubleDouble two_pi{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};

/// Adding this before truncation rounds to the nearest; std::lround would be a function call.
inline constexpr double to_nearest = 0.5;

/// v, with |v| < 2^63 unit, truncated to a multiple of `unit`, a power of two.
constexpr double upper_bits(double v, double unit) {
  return static_cast<double>(static_cast<std::int64_t>(v / unit)) * unit;
}

}  // namespace kinemend::portable
