// Sines, cosines and tangents from a table of 128 steps of a turn and short series (Gal 1991, Tang
// 1991).
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/bits.hpp"
#include "base/double_double.hpp"
#include "base/portable.hpp"
#include "base/portable_pi.hpp"

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

}  // namespace kinemend::portable
