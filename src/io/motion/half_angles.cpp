// Computes sines and cosines of half angles by series that compilers turn into SIMD code.
#include "io/motion/half_angles.hpp"

#include <cmath>
#include <cstdint>

#include "base/bits.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

namespace {

// Taylor series; the error on [-pi/4, pi/4] is below 1e-18.
double sine_kernel(double x) {
  const double z = x * x;
  double sum = 1.0 / 355687428096000.0;
  sum = sum * z - 1.0 / 1307674368000.0;
  sum = sum * z + 1.0 / 6227020800.0;
  sum = sum * z - 1.0 / 39916800.0;
  sum = sum * z + 1.0 / 362880.0;
  sum = sum * z - 1.0 / 5040.0;
  sum = sum * z + 1.0 / 120.0;
  sum = sum * z - 1.0 / 6.0;
  return x + x * (z * sum);
}

double cosine_kernel(double x) {
  const double z = x * x;
  double sum = 1.0 / 20922789888000.0;
  sum = sum * z - 1.0 / 87178291200.0;
  sum = sum * z + 1.0 / 479001600.0;
  sum = sum * z - 1.0 / 3628800.0;
  sum = sum * z + 1.0 / 40320.0;
  sum = sum * z - 1.0 / 720.0;
  sum = sum * z + 1.0 / 24.0;
  sum = sum * z - 0.5;
  return 1.0 + z * sum;
}

// The loop has no branches so that it becomes SIMD code. |degrees| is at most 1e12.
void sincos_block(const double* __restrict degrees, std::size_t count, double* __restrict sines,
                  double* __restrict cosines) {
  // Adding 1.5 * 2^52 rounds to an integer and leaves it in the low bits.
  constexpr double rounder = 6755399441055744.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double shifted = degrees[i] * (1.0 / 180.0) + rounder;
    const double remainder = degrees[i] - 180.0 * (shifted - rounder);
    const std::uint64_t quarter = bits_as<std::uint64_t>(shifted);
    const double x = remainder * (pi / 360.0);
    const std::uint64_t s = bits_as<std::uint64_t>(sine_kernel(x));
    const std::uint64_t c = bits_as<std::uint64_t>(cosine_kernel(x));
    const std::uint64_t swap = 0 - (quarter & 1);
    const std::uint64_t exchange = (s ^ c) & swap;
    sines[i] = bits_as<double>((s ^ exchange) ^ (quarter & 2) << 62);
    cosines[i] = bits_as<double>((c ^ exchange) ^ ((quarter + 1) & 2) << 62);
  }
}

}  // namespace

void half_angle_sincos(const double* degrees, std::size_t count, double* sines, double* cosines) {
  sincos_block(degrees, count, sines, cosines);
  // Degrees above which the fast sines lose digits; chosen by hand, not swept.
  constexpr double exact_limit = 1e12;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::fabs(degrees[i]) <= exact_limit) continue;
    const double reduced = std::fmod(degrees[i], 720.0);
    sincos_block(&reduced, 1, sines + i, cosines + i);
  }
}

}  // namespace kinemend
