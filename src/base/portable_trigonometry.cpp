// Computes sines, cosines and tangents from a table of 128 steps of a turn and short series (Gal
// 1991, Tang 1991), and arc functions and lengths from a table of arc tangents, in numbers of 106
// bits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/double_double.hpp"
#include "base/portable.hpp"

namespace kinemend::portable {

namespace {

constexpr int turn_steps = 128, quarter_steps = turn_steps / 4;

// Sine and cosine of v, for 0 <= v < 1.
constexpr DoubleDouble series_sine(DoubleDouble v, bool is_cosine) {
  const DoubleDouble square = v * v;
  DoubleDouble term = is_cosine ? DoubleDouble{1} : v, sum = term;
  for (int n = is_cosine ? 1 : 2; n < 32; n += 2) {
    term = -(term * square / DoubleDouble{1.0 * n * (n + 1)});
    sum = sum + term;
  }
  return sum;
}

constexpr DoubleDouble angle_step = two_pi * DoubleDouble{1.0 / turn_steps};
// A step in three parts. The first two have 33 bits, so they are exact times whole numbers below
// 2^20.
constexpr double angle_step_upper = upper_bits(angle_step.hi, 0x1p-37);
constexpr double angle_step_middle =
    upper_bits((angle_step.hi - angle_step_upper) + angle_step.lo, 0x1p-70);
constexpr double angle_step_lower =
    ((angle_step.hi - angle_step_upper) - angle_step_middle) + angle_step.lo;
// Up to this angle the three parts are enough.
constexpr double largest_small_angle = 32768;

// Sines of the steps of a quarter, and of its end.
constexpr auto sine_table = [] {
  std::array<DoubleDouble, quarter_steps + 1> table;
  for (int i = 0; i <= quarter_steps; ++i) {
    const bool is_cosine = 2 * i > quarter_steps;
    const int steps = is_cosine ? quarter_steps - i : i;
    table[static_cast<std::size_t>(i)] =
        series_sine(DoubleDouble{1.0 * steps} * angle_step, is_cosine);
  }
  return table;
}();

// The sine at a step of the turn.
DoubleDouble sine_at(std::uint32_t step) {
  const std::uint32_t within = step % quarter_steps, quarter = step / quarter_steps % 4;
  const DoubleDouble size = sine_table[quarter % 2 == 0 ? within : quarter_steps - within];
  return quarter < 2 ? size : -size;
}

// step * angle_step + rest, where |rest| is at most half a step.
struct Reduced {
  std::uint32_t step;
  DoubleDouble rest;
};

Reduced reduced_small(double angle) {
  const double steps = std::floor(angle * (turn_steps / two_pi.hi) + 0.5);
  const double upper = angle - steps * angle_step_upper;
  const DoubleDouble middle = exact_sum(upper, -(steps * angle_step_middle));
  const DoubleDouble lower = exact_product(steps, angle_step_lower);
  const DoubleDouble sum = exact_sum(middle.hi, -lower.hi);
  return {static_cast<std::uint32_t>(static_cast<std::int32_t>(steps)),
          quick_sum(sum.hi, sum.lo + (middle.lo - lower.lo))};
}

// The fraction bits of 1 / (2 pi) (Payne and Hanek 1983).
constexpr std::array<std::uint32_t, 40> turns_per_radian = {
    0x28BE60DBU, 0x9391054AU, 0x7F09D5F4U, 0x7D4D3770U, 0x36D8A566U, 0x4F10E410U, 0x7F9458EAU,
    0xF7AEF158U, 0x6DC91B8EU, 0x909374B8U, 0x01924BBAU, 0x82746487U, 0x3F877AC7U, 0x2C4A69CFU,
    0xBA208D7DU, 0x4BAED121U, 0x3A671C09U, 0xAD17DF90U, 0x4E64758EU, 0x60D4CE7DU, 0x272117E2U,
    0xEF7E4A0EU, 0xC7FE25FFU, 0xF7816603U, 0xFBCBC462U, 0xD6829B47U, 0xDB4D9FB3U, 0xC9F2C26DU,
    0xD3D18FD9U, 0xA797FA8BU, 0x5D49EEB1U, 0xFAF97C5EU, 0xCF41CE7DU, 0xE294A4BAU, 0x9AFED7ECU,
    0x47E35742U, 0x1580CC11U, 0xBF1EDAEAU, 0xFC33EF08U, 0x26BD0D87U};

// 32 of these bits, from the one of weight 2^-(first + 1) on; those of the integer part are 0.
std::uint32_t bits_from(int first) {
  const auto word = [](int index) -> std::uint64_t {
    return index < 0 ? 0 : turns_per_radian[static_cast<std::size_t>(index)];
  };
  const int index = (first + 64) / 32 - 2, shift = first - 32 * index;
  return static_cast<std::uint32_t>(((word(index) << 32U) | word(index + 1)) >> (32 - shift));
}

// For largest_small_angle <= angle < infinity: the angle is m 2^e with a whole m of 53 bits, and
// whole turns drop out of m times the 192 bits of 1 / (2 pi) below the weight 2^-e.
Reduced reduced_large(double angle) {
  int exponent = 0;
  const auto whole = static_cast<std::uint64_t>(std::ldexp(std::frexp(angle, &exponent), 53));
  exponent -= 53;
  constexpr int limbs = 6;
  std::array<std::uint32_t, limbs> product{};  // in turns, the uppermost first
  for (int part = 0; part < 2; ++part) {
    const std::uint64_t factor = part == 0 ? whole & 0xFFFFFFFFU : whole >> 32U;
    std::uint64_t carry = 0;
    for (int limb = limbs - 1 - part; limb >= 0; --limb) {
      auto& sum = product[static_cast<std::size_t>(limb)];
      carry += factor * bits_from(exponent + 32 * (limb + part)) + sum;
      sum = static_cast<std::uint32_t>(carry);
      carry >>= 32U;
    }
  }
  const std::uint32_t step = (product[0] + (1U << 24U)) >> 25U;
  // The remainder, in units of 2^-32, 2^-64 and so on of a turn.
  const auto left = static_cast<std::int32_t>(product[0] - (step << 25U));
  DoubleDouble turns{static_cast<double>(left) * 0x1p-32};
  double weight = 0x1p-64;
  for (std::size_t limb = 1; limb < limbs; ++limb, weight *= 0x1p-32)
    turns = turns + DoubleDouble{weight * product[limb]};
  return {step, turns * two_pi};
}

Reduced reduced(double angle) {
  if (std::fabs(angle) < largest_small_angle) return reduced_small(angle);
  const Reduced size = reduced_large(std::fabs(angle));
  return angle > 0 ? size : Reduced{0U - size.step, -size.rest};
}

// sin(a + r) = sin a + (cos a sin r + sin a (cos r - 1)); its main part is sin a + cos a r.
DoubleDouble sine_near(DoubleDouble sine, DoubleDouble cosine, DoubleDouble r) {
  const double square = r.hi * r.hi;
  const double sine_rest =
      r.lo +
      r.hi * square * (-1.0 / 6 + square * (1.0 / 120 + square * (-1.0 / 5040 + square / 362880)));
  const double cosine_rest =
      square * (-1.0 / 2 + square * (1.0 / 24 + square * (-1.0 / 720 + square / 40320))) -
      r.hi * r.lo;
  const DoubleDouble main = exact_product(cosine.hi, r.hi);
  const DoubleDouble sum = exact_sum(sine.hi, main.hi);
  return quick_sum(sum.hi, sum.lo + (main.lo + (cosine.lo * r.hi + cosine.hi * sine_rest +
                                                (sine.hi * cosine_rest + sine.lo))));
}

DoubleDouble sine_of(const Reduced& angle) {
  return sine_near(sine_at(angle.step), sine_at(angle.step + quarter_steps), angle.rest);
}

DoubleDouble cosine_of(const Reduced& angle) {
  return sine_of({angle.step + quarter_steps, angle.rest});
}

// Tiny angles are their own sine and tangent: a denormal product would lose bits.
bool is_tiny(double angle) { return std::fabs(angle) < 0x1p-27; }

constexpr double no_angle = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SineAndCosine sine_and_cosine(double angle) {
  if (is_tiny(angle)) return {angle, 1};
  if (!std::isfinite(angle)) return {no_angle, no_angle};
  const Reduced turn = reduced(angle);
  return {sine_of(turn).hi, cosine_of(turn).hi};
}

double sin(double angle) {
  if (is_tiny(angle)) return angle;
  return std::isfinite(angle) ? sine_of(reduced(angle)).hi : no_angle;
}

double cos(double angle) {
  if (is_tiny(angle)) return 1;
  return std::isfinite(angle) ? cosine_of(reduced(angle)).hi : no_angle;
}

double tan(double angle) {
  if (is_tiny(angle)) return angle;
  if (!std::isfinite(angle)) return no_angle;
  const Reduced turn = reduced(angle);
  return quick_quotient(sine_of(turn), cosine_of(turn)).hi;
}

namespace {

constexpr DoubleDouble half_pi = two_pi * DoubleDouble{0.25}, whole_pi = two_pi * DoubleDouble{0.5};

constexpr int arc_steps = 64;

// arctan(v), for |v| <= 1 / 64.
constexpr DoubleDouble series_arc(DoubleDouble v) {
  const DoubleDouble square = v * v;
  DoubleDouble power = v, sum = v;
  for (int n = 3; n < 20; n += 2) {
    power = -(power * square);
    sum = sum + power / DoubleDouble{static_cast<double>(n)};
  }
  return sum;
}

// arctan(i / 64): each adds arctan((b - a) / (1 + a b)) to the one before.
constexpr auto arc_table = [] {
  std::array<DoubleDouble, arc_steps + 1> table;
  for (std::size_t i = 1; i <= arc_steps; ++i) {
    const double product = static_cast<double>(i * (i - 1)) / arc_steps;
    table[i] = table[i - 1] + series_arc(DoubleDouble{1} / DoubleDouble{arc_steps + product});
  }
  return table;
}();

// c v without error except in the last bits of v.lo, for c of 7 bits.
DoubleDouble times(double c, DoubleDouble v) {
  const double upper = upper_half(v.hi);
  return quick_sum(c * upper, c * (v.hi - upper) + c * v.lo);
}

// a + b and a - b for a.hi >= b.hi / 2 >= 0.
DoubleDouble more(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble sum = exact_sum(a.hi, b.hi);
  return quick_sum(sum.hi, sum.lo + (a.lo + b.lo));
}
DoubleDouble less(DoubleDouble a, DoubleDouble b) { return more(a, -b); }

// arctan(y / x) for 0 <= y <= x, x > 0: arctan c + arctan((y - c x) / (x + c y)) with c near y / x.
DoubleDouble arc_of(DoubleDouble y, DoubleDouble x) {
  const int step = static_cast<int>(y.hi / x.hi * arc_steps + to_nearest);
  const double c = 1.0 * step / arc_steps;
  const DoubleDouble t =
      step == 0 ? quick_quotient(y, x) : quick_quotient(less(y, times(c, x)), more(x, times(c, y)));
  const double square = t.hi * t.hi;
  const double rest =
      t.lo -
      t.hi * square *
          (1.0 / 3 - square * (1.0 / 5 - square * (1.0 / 7 - square * (1.0 / 9 - square / 11))));
  const DoubleDouble entry = arc_table[static_cast<std::size_t>(step)];
  const DoubleDouble sum = exact_sum(entry.hi, t.hi);
  return quick_sum(sum.hi, sum.lo + (entry.lo + rest));
}

// The angle of (x, y), for y >= 0 and one of them not 0.
DoubleDouble angle_of(DoubleDouble y, DoubleDouble x) {
  const DoubleDouble size = x.hi < 0 ? -x : x;
  const DoubleDouble arc = y.hi > size.hi ? half_pi - arc_of(size, y) : arc_of(y, size);
  return x.hi < 0 ? whole_pi - arc : arc;
}

// sqrt(1 - x^2), for |x| <= 1.
DoubleDouble other_leg(double x) {
  const DoubleDouble square = exact_product(x, x);
  return square_root(DoubleDouble{1} - square);
}

constexpr double no_arc = std::numeric_limits<double>::quiet_NaN();

// The power of two that scales the larger of two finite numbers to between 1/2 and 1.
int exponent_of(double size) {
  int exponent = 0;
  std::frexp(size, &exponent);
  return exponent;
}

// Angles, without the sign of y, if one number is 0 or infinite, or both are far apart.
double special_angle(double y, double x) {
  const double size = std::fabs(y), width = std::fabs(x);
  if (std::isinf(size)) {
    if (std::isinf(width)) return x > 0 ? whole_pi.hi / 4 : 0.75 * whole_pi.hi;
    return half_pi.hi;
  }
  if (size == 0 || std::isinf(width)) return std::signbit(x) ? whole_pi.hi : 0.0;
  if (width == 0 || exponent_of(size) > exponent_of(width)) return half_pi.hi;
  return std::signbit(x) ? whole_pi.hi : size / width;
}

bool is_far(double size, double width) {
  if (size == 0 || width == 0 || std::isinf(size) || std::isinf(width)) return true;
  return std::abs(exponent_of(size) - exponent_of(width)) > 60;
}

// Whether products with the number neither overflow nor lose bits.
bool is_usual(double size) { return size > 0x1p-400 && size < 0x1p400; }

}  // namespace

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double size = std::fabs(y), width = std::fabs(x);
  if (is_usual(size) && is_usual(width) && size < 0x1p60 * width && width < 0x1p60 * size)
    return std::copysign(angle_of({size}, {x}).hi, y);
  if (is_far(size, width)) return std::copysign(special_angle(y, x), y);
  const int exponent = exponent_of(std::max(size, width));
  return std::copysign(angle_of({std::ldexp(size, -exponent)}, {std::ldexp(x, -exponent)}).hi, y);
}

double atan(double x) { return atan2(x, 1); }

double acos(double x) {
  if (!(std::fabs(x) <= 1)) return no_arc;
  if (std::fabs(x) < 0x1p-60) return half_pi.hi;
  return angle_of(other_leg(x), {x}).hi;
}

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return std::numeric_limits<double>::infinity();
  const double larger = std::max(std::fabs(x), std::fabs(y));
  if (larger == 0 || std::isnan(x) || std::isnan(y)) return std::fabs(x) + std::fabs(y);
  const int exponent = is_usual(larger) ? 0 : exponent_of(larger);
  const double a = std::ldexp(x, -exponent), b = std::ldexp(y, -exponent);
  const DoubleDouble square = exact_product(a, a) + exact_product(b, b);
  return std::ldexp(square_root(square).hi, exponent);
}

}  // namespace kinemend::portable
