// 2 pi to 106 bits, and how numbers are cut to whole steps and to upper bits.
#pragma once

#include <cstdint>

#include "base/double_double.hpp"

namespace kinemend::portable {

inline constexpr DoubleDouble two_pi{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};

/// What is cut to a whole number after adding it becomes the nearest; std::lround is a call.
inline constexpr double to_nearest = 0.5;

/// v, of |v| < 2^63 unit, cut to a whole number of units, a power of two.
constexpr double upper_bits(double v, double unit) {
  return static_cast<double>(static_cast<std::int64_t>(v / unit)) * unit;
}

}  // namespace kinemend::portable
