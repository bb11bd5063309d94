// Declares the functions of the standard library that systems lack or round differently. They give
// the same bits on every system and processor.
#pragma once

namespace kinemend::portable {

// They use only additions, multiplications, divisions and square roots of doubles, which IEEE 754
// defines to the last bit. Nearly every value is the double nearest to the exact one; the others
// are the next nearest (tests/base/portable_test.cpp). Special values are those of C: NaN gives
// NaN, infinities give their limits.

[[nodiscard]] double exp(double x);
/// e^x - 1.
[[nodiscard]] double expm1(double x);
[[nodiscard]] double log(double x);
[[nodiscard]] double log2(double x);
[[nodiscard]] double log10(double x);
/// log(1 + x).
[[nodiscard]] double log1p(double x);
[[nodiscard]] double pow(double x, double y);
[[nodiscard]] double cbrt(double x);
[[nodiscard]] double asinh(double x);
/// The gamma function and its logarithm, for x > 0, to a relative error of 1e-14.
[[nodiscard]] double tgamma(double x);
[[nodiscard]] double lgamma(double x);

/// Angles in radians, of any size.
struct SineAndCosine {
  double sine, cosine;
};
[[nodiscard]] SineAndCosine sine_and_cosine(double angle);
[[nodiscard]] double sin(double angle);
[[nodiscard]] double cos(double angle);
[[nodiscard]] double tan(double angle);

[[nodiscard]] double acos(double x);
[[nodiscard]] double atan(double x);
[[nodiscard]] double atan2(double y, double x);
/// sqrt(x^2 + y^2).
[[nodiscard]] double hypot(double x, double y);

// In single precision; computing in double precision makes them as exact.
[[nodiscard]] float exp(float x);
[[nodiscard]] float log(float x);
[[nodiscard]] float asinh(float x);

}  // namespace kinemend::portable

namespace kinemend {

/// Like std::bit_cast, which the standard library of Emscripten lacks.
template <class To, class From>
constexpr To bits_as(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace kinemend
