// Arc functions from a table of arc tangents and a short series, and lengths, in numbers of 106
// bits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>

#include "base/double_double.hpp"
#include "base/portable.hpp"
#include "base/portable_pi.hpp"

namespace kinemend::portable {

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

double asin(double x) {
  if (!(std::fabs(x) <= 1)) return no_arc;
  if (std::fabs(x) < 0x1p-27) return x;
  return std::copysign(angle_of({std::fabs(x)}, other_leg(x)).hi, x);
}

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
