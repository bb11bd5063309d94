// Represents numbers of about 106 bits as sums of two doubles, with 2 pi among them. Only additions
// and multiplications of doubles are used, which are the same on every system (Dekker 1971, Knuth
// 1969).
#pragma once

#include <cmath>
#include <cstdint>

namespace kinemend {

/// hi + lo, where hi is the double nearest to the sum.
struct DoubleDouble {
  double hi = 0, lo = 0;
};

/// a + b without error, for |a| >= |b| or a = 0.
constexpr DoubleDouble quick_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b without error.
constexpr DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// The upper 26 bits of a; |a| < 2^996.
constexpr double upper_half(double a) {
  const double c = 134217729.0 * a;
  return c - (c - a);
}

/// a b without error, for |a|, |b| < 2^996 whose product is not denormal.
constexpr DoubleDouble exact_product(double a, double b) {
  const double product = a * b;
  const double a_hi = upper_half(a), a_lo = a - a_hi, b_hi = upper_half(b), b_lo = b - b_hi;
  return {product, ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }

constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble upper = exact_sum(a.hi, b.hi), lower = exact_sum(a.lo, b.lo);
  const DoubleDouble sum = quick_sum(upper.hi, upper.lo + lower.hi);
  return quick_sum(sum.hi, sum.lo + lower.lo);
}

constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + (-b); }

constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble product = exact_product(a.hi, b.hi);
  return quick_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// Relative error about 2^-100; b != 0.
constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - DoubleDouble{first} * b;
  const double second = rest.hi / b.hi;
  const DoubleDouble last = rest - DoubleDouble{second} * b;
  return quick_sum(first, second) + DoubleDouble{last.hi / b.hi};
}

/// a / b with one division; relative error about 2^-100.
constexpr DoubleDouble quick_quotient(DoubleDouble a, DoubleDouble b) {
  const double inverse = 1 / b.hi, first = a.hi * inverse;
  const DoubleDouble product = exact_product(first, b.hi);
  const double rest = ((a.hi - product.hi) - product.lo) + (a.lo - first * b.lo);
  return quick_sum(first, rest * inverse);
}

/// The square root of a >= 0.
inline DoubleDouble square_root(DoubleDouble a) {
  const double root = std::sqrt(a.hi);
  if (root == 0) return {};
  const DoubleDouble square = exact_product(root, root);
  return quick_sum(root, (((a.hi - square.hi) - square.lo) + a.lo) / (2 * root));
}

}  // namespace kinemend

namespace kinemend::portable {

inline constexpr DoubleDouble two_pi{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};

/// Adding this before truncation rounds to the nearest; std::lround would be a function call.
inline constexpr double to_nearest = 0.5;

/// v, with |v| < 2^63 unit, truncated to a multiple of `unit`, a power of two.
constexpr double upper_bits(double v, double unit) {
  return static_cast<double>(static_cast<std::int64_t>(v / unit)) * unit;
}

}  // namespace kinemend::portable
