// Exponentials, logarithms and powers from tables and short series (Tang 1989, 1990).
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "base/double_double.hpp"
#include "base/portable.hpp"

namespace kinemend::portable {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// log(v) = 2 artanh((v - 1) / (v + 1)), for v of 1/2 to 2.
constexpr DoubleDouble series_log(DoubleDouble v) {
  const DoubleDouble t = (v - DoubleDouble{1}) / (v + DoubleDouble{1}), square = t * t;
  DoubleDouble sum, power = t;
  for (int n = 1; n < 80; n += 2) {
    sum = sum + power / DoubleDouble{static_cast<double>(n)};
    power = power * square;
  }
  return sum + sum;
}

// e^v, for |v| < 1.
constexpr DoubleDouble series_exp(DoubleDouble v) {
  DoubleDouble sum{1}, term{1};
  for (int n = 1; n < 30; ++n) {
    term = term * v / DoubleDouble{static_cast<double>(n)};
    sum = sum + term;
  }
  return sum;
}

constexpr DoubleDouble log_of_2 = series_log(DoubleDouble{2});
constexpr DoubleDouble log_of_10 =
    DoubleDouble{3} * log_of_2 + series_log(DoubleDouble{10} / DoubleDouble{8});
constexpr DoubleDouble per_log_of_2 = DoubleDouble{1} / log_of_2;
constexpr DoubleDouble per_log_of_10 = DoubleDouble{1} / log_of_10;

// Steps of log(2) / 128 of an exponent. A step's upper 35 bits times a whole number below 2^18 are
// exact.
constexpr int exp_steps = 128;
constexpr DoubleDouble exp_step = log_of_2 * DoubleDouble{1.0 / exp_steps};
constexpr double exp_step_upper = upper_bits(exp_step.hi, 0x1p-43);
constexpr double exp_step_lower = (exp_step.hi - exp_step_upper) + exp_step.lo;
constexpr double least_exponent = -746, largest_exponent = 710;

constexpr auto exp_table = [] {
  std::array<DoubleDouble, exp_steps> table;
  for (int i = 0; i < exp_steps; ++i)
    table[static_cast<std::size_t>(i)] = series_exp(DoubleDouble{1.0 * i} * exp_step);
  return table;
}();

// A number times 2^exponent.
struct Scaled {
  DoubleDouble value;
  int exponent;
};

// exp(hi + lo) to a relative error of about 2^-61, for hi from least_exponent to largest_exponent.
Scaled scaled_exp(double hi, double lo) {
  const double steps = std::floor(hi * (exp_steps * std::numbers::log2e) + 0.5);
  const DoubleDouble r = quick_sum(hi - steps * exp_step_upper, lo - steps * exp_step_lower);
  const double x = r.hi;
  const double rest =
      r.lo + x * x * (1.0 / 2 + x * (1.0 / 6 + x * (1.0 / 24 + x * (1.0 / 120 + x / 720))));
  const int whole = static_cast<int>(steps);
  const DoubleDouble entry = exp_table[static_cast<std::size_t>(whole & (exp_steps - 1))];
  return {{entry.hi, entry.lo + entry.hi * (x + rest)}, whole >> 7};
}

double value_of(const Scaled& scaled) {
  const double sum = scaled.value.hi + scaled.value.lo;
  if (scaled.exponent > -1000 && scaled.exponent < 1000)
    return sum * bits_as<double>(static_cast<std::uint64_t>(scaled.exponent + 1023) << 52U);
  return std::ldexp(sum, scaled.exponent);
}

double exp_of(double hi, double lo) {
  if (hi > largest_exponent) return infinity;
  if (hi < least_exponent) return 0;
  return value_of(scaled_exp(hi, lo));
}

// There are 128 steps from 1 to 2; the table holds those from sqrt(1/2) to sqrt(2), and the inverse
// of each with 10 bits, so that products with half a double are exact.
constexpr int log_steps = 128, first_log_step = 90, last_log_step = 182;
struct LogEntry {
  double inverse = 1;
  DoubleDouble log;
};

constexpr auto log_table = [] {
  std::array<LogEntry, last_log_step - first_log_step + 1> table;
  for (int j = first_log_step; j <= last_log_step; ++j) {
    const double inverse = upper_bits(1.0 * log_steps / j + 0x1p-10, 0x1p-9);
    table[static_cast<std::size_t>(j - first_log_step)] = {inverse,
                                                           -series_log(DoubleDouble{inverse})};
  }
  return table;
}();

constexpr double log_of_2_upper = upper_bits(log_of_2.hi, 0x1p-42);
constexpr double log_of_2_lower = (log_of_2.hi - log_of_2_upper) + log_of_2.lo;

// log(1 + r) to a relative error of about 2^-66, for |r| < 2^-7.
DoubleDouble log_near_one(DoubleDouble r) {
  const double x = r.hi;
  const DoubleDouble square = exact_product(x, x);
  const double rest =
      x * square.hi *
      (1.0 / 3 -
       x * (1.0 / 4 -
            x * (1.0 / 5 -
                 x * (1.0 / 6 - x * (1.0 / 7 - x * (1.0 / 8 - x * (1.0 / 9 - x / 10)))))));
  const DoubleDouble sum = quick_sum(x, -0.5 * square.hi);
  return quick_sum(sum.hi, sum.lo + (r.lo - 0.5 * square.lo - x * r.lo + rest));
}

// x = 2^exponent z, where z lies about a step of the table.
struct LogParts {
  double exponent, z;
  const LogEntry* entry;
};

LogParts log_parts(double x) {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  const auto bits = bits_as<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52U) - 1023;
  double z = bits_as<double>((bits & 0x000FFFFFFFFFFFFFU) | 0x3FF0000000000000U);
  if (z > std::numbers::sqrt2) {
    z *= 0.5;
    ++exponent;
  }
  const int step = static_cast<int>(z * log_steps + to_nearest);
  return {static_cast<double>(exponent), z,
          &log_table[static_cast<std::size_t>(step - first_log_step)]};
}

// log(x) to a relative error of about 2^-66, for finite x > 0.
DoubleDouble log_of(double x) {
  const auto [exponent, z, entry] = log_parts(x);
  const double upper = bits_as<double>(bits_as<std::uint64_t>(z) & 0xFFFFFFFFF8000000U);
  const DoubleDouble r = exact_sum(upper * entry->inverse - 1, (z - upper) * entry->inverse);
  const DoubleDouble rest = log_near_one(r);
  const DoubleDouble whole = exact_sum(exponent * log_of_2_upper, entry->log.hi);
  const DoubleDouble sum = exact_sum(whole.hi, rest.hi);
  return quick_sum(sum.hi,
                   sum.lo + (whole.lo + (rest.lo + (exponent * log_of_2_lower + entry->log.lo))));
}

// log(x) to an absolute error of about 2^-50, or a relative one near 1; for finite x > 0.
double short_log(double x) {
  const auto [exponent, z, entry] = log_parts(x);
  const double r = z * entry->inverse - 1;
  const double rest =
      r - r * r * (1.0 / 2 - r * (1.0 / 3 - r * (1.0 / 4 - r * (1.0 / 5 - r * (1.0 / 6 - r / 7)))));
  return exponent * log_of_2.hi + (entry->log.hi + rest);
}

// The logarithm of a number that has no finite one: zero, a negative number, infinity or NaN.
double special_log(double x) {
  if (x == 0) return -infinity;
  if (x < 0) return not_a_number;
  return x;  // infinite, or not a number
}

bool has_log(double x) { return x > 0 && x < infinity; }

bool is_whole(double y) { return std::floor(y) == y; }
bool is_odd(double y) { return is_whole(y) && std::fabs(y) < 0x1p53 && std::fmod(y, 2) != 0; }

// x|^y for x of zero or infinity, or infinite y, where the sign of x is handled elsewhere.
double special_power(double x, double y) {
  if (std::isinf(y)) {
    if (x == 1) return 1;
    return (x > 1) == (y > 0) ? infinity : 0;
  }
  return (x == 0) == (y < 0) ? infinity : 0;
}

double positive_power(double x, double y) {
  if (x == 0 || std::isinf(x) || std::isinf(y)) return special_power(x, y);
  const DoubleDouble log = log_of(x);
  const double about = y * log.hi;
  if (about > largest_exponent) return infinity;
  if (about < least_exponent) return 0;
  if (std::fabs(about) < 0x1p-60) return 1;
  const DoubleDouble product = exact_product(y, log.hi);
  return exp_of(product.hi, product.lo + y * log.lo);
}

}  // namespace

double exp(double x) { return std::isnan(x) ? x : exp_of(x, 0); }

double expm1(double x) {
  if (std::isnan(x)) return x;
  if (x > largest_exponent) return infinity;
  if (x < -60) return -1;
  if (std::fabs(x) < 0x1p-54) return x;
  if (std::fabs(x) < 0.125) {
    double series = 0;
    for (int n = 14; n >= 3; --n) series = (series + 1) * x / n;
    const double half_square = 0.5 * x * x;
    return x + (half_square + half_square * series);
  }
  const Scaled scaled = scaled_exp(x, 0);
  if (scaled.exponent >= 1000) return value_of(scaled);
  const double factor = std::ldexp(1.0, scaled.exponent);
  const DoubleDouble sum = exact_sum(factor * scaled.value.hi, -1);
  return sum.hi + (sum.lo + factor * scaled.value.lo);
}

double log(double x) { return has_log(x) ? log_of(x).hi : special_log(x); }

double log2(double x) { return has_log(x) ? (log_of(x) * per_log_of_2).hi : special_log(x); }

double log10(double x) { return has_log(x) ? (log_of(x) * per_log_of_10).hi : special_log(x); }

double log1p(double x) {
  if (std::fabs(x) < 0x1p-54) return x;
  const DoubleDouble sum = exact_sum(1, x);
  if (!has_log(sum.hi)) return special_log(sum.hi);
  const DoubleDouble log = log_of(sum.hi);
  return log.hi + (log.lo + sum.lo / sum.hi);
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double size = positive_power(std::fabs(x), y);
  if (!std::signbit(x)) return size;
  if (is_odd(y)) return -size;
  return x == 0 || std::isinf(x) || is_whole(y) ? size : not_a_number;
}

double cbrt(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  int exponent = 0;
  const double size = std::frexp(std::fabs(x), &exponent);
  const int thirds = (exponent + 3000) / 3 - 1000;
  const double scaled = std::ldexp(size, exponent - 3 * thirds);
  const double root = exp_of(log_of(scaled).hi / 3, 0);
  const DoubleDouble cube = exact_product(root, root) * DoubleDouble{root};
  const double better = root + (DoubleDouble{scaled} - cube).hi / (3 * root * root);
  return std::copysign(std::ldexp(better, thirds), x);
}

double asinh(double x) {
  const double size = std::fabs(x);
  if (size > 0x1p30) return std::copysign(log(size) + log_of_2.hi, x);
  const double square = size * size;
  return std::copysign(log1p(size + square / (1 + std::sqrt(1 + square))), x);
}

double lgamma(double x) {
  // Stirling's series from 16 on; below, Gamma(x) = Gamma(x + n) / (x (x + 1) .. (x + n - 1)).
  double product = 1;
  while (x < 16) product *= x++;
  const double inverse = 1 / x, square = inverse * inverse;
  const double series =
      inverse *
      (1.0 / 12 -
       square * (1.0 / 360 -
                 square * (1.0 / 1260 -
                           square * (1.0 / 1680 - square * (1.0 / 1188 - square * 691 / 360360)))));
  return (x - 0.5) * log(x) - x + 0.5 * log(2 * std::numbers::pi) + series - log(product);
}

double tgamma(double x) { return exp(lgamma(x)); }

float exp(float x) { return static_cast<float>(exp(static_cast<double>(x))); }

float log(float x) {
  const auto exact = static_cast<double>(x);
  return static_cast<float>(has_log(exact) ? short_log(exact) : special_log(exact));
}

float asinh(float x) {
  const auto size = static_cast<double>(std::fabs(x));
  if (!std::isfinite(x)) return x;
  // This is log(1 + u), corrected for the rounding error of 1 + u.
  const double u = size + size * size / (1 + std::sqrt(1 + size * size)), sum = 1 + u;
  return std::copysign(static_cast<float>(short_log(sum) + (u - (sum - 1)) / sum), x);
}

}  // namespace kinemend::portable
