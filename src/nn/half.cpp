// Converts between doubles and the bits of half-precision numbers without processor support.
#include "nn/half.hpp"

#include <cmath>

#include "base/portable.hpp"

namespace kinemend {

namespace {

// By definition of IEEE 754 binary16.
constexpr double overflow = 65520;
constexpr double least_normal = 0x1p-14;
constexpr double subnormal_step = 0x1p-24;
constexpr unsigned dropped_bits = 52 - 10;
constexpr std::uint64_t bias_difference = 1023 - 15;

// Rounds a finite `size` from `least_normal` on. A carry out of the mantissa correctly increments
// the exponent.
std::uint16_t normal_half(double size) {
  const auto bits = bits_as<std::uint64_t>(size);
  const std::uint64_t is_odd = (bits >> dropped_bits) & 1;
  const std::uint64_t rounded = bits + ((std::uint64_t{1} << (dropped_bits - 1)) - 1) + is_odd;
  return static_cast<std::uint16_t>((rounded >> dropped_bits) - (bias_difference << 10));
}

}  // namespace

std::uint16_t to_half(double value) {
  const auto sign = static_cast<std::uint16_t>(std::signbit(value) ? 0x8000 : 0);
  const double size = std::abs(value);
  if (std::isnan(value)) return static_cast<std::uint16_t>(sign | 0x7E00);
  if (size >= overflow) return static_cast<std::uint16_t>(sign | 0x7C00);
  // The largest subnormal may round up to the least normal, whose bits follow directly.
  const auto half = size < least_normal
                        ? static_cast<std::uint16_t>(std::nearbyint(size / subnormal_step))
                        : normal_half(size);
  return static_cast<std::uint16_t>(sign | half);
}

double from_half(std::uint16_t half) {
  const std::uint64_t sign = static_cast<std::uint64_t>(half >> 15) << 63;
  const std::uint64_t exponent = (half >> 10) & 31u;
  const std::uint64_t mantissa = half & 0x3FFu;
  if (exponent == 0) {
    const double size = static_cast<double>(mantissa) * subnormal_step;
    return sign != 0 ? -size : size;
  }
  const std::uint64_t wide_exponent = exponent == 31 ? 2047 : exponent + bias_difference;
  return bits_as<double>(sign | wide_exponent << 52 | mantissa << dropped_bits);
}

}  // namespace kinemend
