// Compares the portable functions with 80-bit references and tries special values.
#include "base/portable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "kinemend/extend/random.hpp"

namespace kinemend {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
// The reference needs at least 64 bits of mantissa to be more exact than the tested functions.
constexpr bool is_long_double_longer = std::numeric_limits<long double>::digits >= 64;

// Error in units of the exact value's last place.
double units_off(double value, long double exact) {
  const double near = std::fabs(static_cast<double>(exact));
  const double unit = std::nextafter(near, infinity) - near;
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) /
                             static_cast<long double>(unit));
}

struct Case {
  std::string name;
  double from, to;
  std::function<double(double)> value;
  std::function<long double(long double)> exact;
  // The arguments lie evenly between `from` and `to`, or their logarithms do.
  bool is_logarithmic = false;
};

void PrintTo(const Case& tried, std::ostream* out) { *out << tried.name; }

class PortableFunction : public testing::TestWithParam<Case> {};

TEST_P(PortableFunction, GivesTheDoubleNextToTheExactValueButForOneInTwoHundred) {
  if (!is_long_double_longer) GTEST_SKIP() << "long double is double here";
  const Case& tried = GetParam();
  Random random(7);
  double most = 0;
  int unequal = 0;
  constexpr int trials = 20000;
  for (int i = 0; i < trials; ++i) {
    const double share = random.uniform();
    const double x = tried.is_logarithmic ? tried.from * std::pow(tried.to / tried.from, share)
                                          : tried.from + (tried.to - tried.from) * share;
    const long double exact = tried.exact(static_cast<long double>(x));
    const double value = tried.value(x);
    if (std::fabs(exact) < 1e-300L) continue;
    most = std::max(most, units_off(value, exact));
    if (value != static_cast<double>(exact)) ++unequal;
  }
  EXPECT_LT(most, 0.54) << "units in the last place";
  EXPECT_LE(unequal, trials / 200);
}

#define KINEMEND_ONE(function) \
  [](double x) { return portable::function(x); }, [](long double x) { return std::function(x); }

INSTANTIATE_TEST_SUITE_P(
    Ranges, PortableFunction,
    testing::Values(Case{"exp", -700, 700, KINEMEND_ONE(exp)},
                    Case{"exp_near_0", -0.01, 0.01, KINEMEND_ONE(exp)},
                    Case{"expm1", -5, 5, KINEMEND_ONE(expm1)},
                    Case{"log", 1e-300, 1e300, KINEMEND_ONE(log), true},
                    Case{"log_near_1", 0.98, 1.02, KINEMEND_ONE(log)},
                    Case{"log2", 1e-3, 1e3, KINEMEND_ONE(log2), true},
                    Case{"log10", 1e-12, 1e12, KINEMEND_ONE(log10), true},
                    Case{"cbrt", 1e-300, 1e300, KINEMEND_ONE(cbrt), true},
                    Case{"sin", -10, 10, KINEMEND_ONE(sin)},
                    Case{"sin_large", 1e4, 1e18, KINEMEND_ONE(sin), true},
                    Case{"cos", -10, 10, KINEMEND_ONE(cos)},
                    Case{"cos_small", 1e-9, 1, KINEMEND_ONE(cos), true},
                    Case{"cos_large", 1e4, 1e18, KINEMEND_ONE(cos), true},
                    Case{"tan", -10, 10, KINEMEND_ONE(tan)},
                    Case{"acos", -1, 1, KINEMEND_ONE(acos)},
                    Case{"atan", -5, 5, KINEMEND_ONE(atan)},
                    Case{"atan_wide", 1e-30, 1e30, KINEMEND_ONE(atan), true},
                    Case{"pow_of_10", -20, 20, [](double x) { return portable::pow(10, x); },
                         [](long double x) { return std::pow(10.0L, x); }},
                    Case{"pow_of_half", 1e-5, 1e5, [](double x) { return portable::pow(x, 1.5); },
                         [](long double x) { return std::pow(x, 1.5L); }, true},
                    Case{"atan2_below", -3, 3, [](double x) { return portable::atan2(x, -1.25); },
                         [](long double x) { return std::atan2(x, -1.25L); }},
                    Case{"hypot", 1e-5, 1e5, [](double x) { return portable::hypot(x, 0.75); },
                         [](long double x) { return std::hypot(x, 0.75L); }, true}),
    [](const testing::TestParamInfo<Case>& tried) { return tried.param.name; });

#undef KINEMEND_ONE

void expect_same(double value, double wanted) {
  if (std::isnan(wanted)) {
    EXPECT_TRUE(std::isnan(value)) << value;
  } else {
    EXPECT_EQ(value, wanted);
    EXPECT_EQ(std::signbit(value), std::signbit(wanted));
  }
}

TEST(Portable, GivesSpecialValuesAsCDoes) {
  const double specials[] = {0.0,    -0.0,   1.0,     -1.0,   infinity, -infinity, nothing,
                             0.5,    -0.5,   2,       3,      -3,       1e10,      1e300,
                             -1e300, 5e-324, -5e-324, 1e-310, 1e-20,    800,       -800};
  for (const double x : specials) {
    SCOPED_TRACE(x);
    expect_same(portable::exp(x), std::exp(x));
    expect_same(portable::expm1(x), static_cast<double>(std::expm1(static_cast<long double>(x))));
    expect_same(portable::log(x), std::log(x));
    expect_same(portable::log2(x), std::log2(x));
    expect_same(portable::log10(x), std::log10(x));
    expect_same(portable::log1p(x), static_cast<double>(std::log1p(static_cast<long double>(x))));
    expect_same(portable::sin(x), std::sin(x));
    expect_same(portable::cos(x), std::cos(x));
    expect_same(portable::tan(x), std::tan(x));
    expect_same(portable::acos(x), std::acos(x));
    expect_same(portable::atan(x), std::atan(x));
    expect_same(portable::sine_and_cosine(x).sine, std::sin(x));
    expect_same(portable::sine_and_cosine(x).cosine, std::cos(x));
    EXPECT_DOUBLE_EQ(std::isnan(x) ? 0 : portable::cbrt(x), std::isnan(x) ? 0 : std::cbrt(x));
    EXPECT_DOUBLE_EQ(std::isnan(x) ? 0 : portable::asinh(x), std::isnan(x) ? 0 : std::asinh(x));
    for (const double y : specials) {
      SCOPED_TRACE(y);
      expect_same(portable::pow(x, y), std::pow(x, y));
      expect_same(portable::atan2(x, y), std::atan2(x, y));
      expect_same(portable::hypot(x, y), std::hypot(x, y));
    }
  }
}

TEST(Portable, ReducesTheLargestAngles) {
  // The second argument is the double nearest to a multiple of a quarter turn (Ng 1992).
  for (const double x : {1e22, 0x1.6ac5b262ca1ffp+849, 1.7976931348623157e308, 1e100, 32768.0}) {
    const auto exact = static_cast<long double>(x);
    EXPECT_EQ(portable::sin(x), static_cast<double>(std::sin(exact)));
    EXPECT_EQ(portable::cos(x), static_cast<double>(std::cos(exact)));
    EXPECT_EQ(portable::tan(-x), static_cast<double>(std::tan(-exact)));
  }
}

TEST(Portable, GivesPowersAndLogarithmsOfWholeTensAndTwosExactly) {
  double power = 1;
  for (int n = 0; n <= 22; ++n, power *= 10) {
    EXPECT_EQ(portable::log10(power), n);
    EXPECT_EQ(portable::pow(10, n), power);
  }
  for (int n = -1074; n < 1024; ++n) {
    EXPECT_EQ(portable::log2(std::ldexp(1.0, n)), n);
    EXPECT_EQ(portable::pow(2, n), std::ldexp(1.0, n));
  }
}

TEST(Portable, GammaIsTheFactorial) {
  double factorial = 1;
  for (int n = 1; n < 30; factorial *= n++) {
    EXPECT_NEAR(portable::tgamma(n) / factorial, 1, 1e-13);
    EXPECT_NEAR(portable::lgamma(n), std::lgamma(n), 1e-13 * std::lgamma(n) + 2e-14);
  }
  EXPECT_NEAR(portable::tgamma(0.5), std::sqrt(std::acos(-1.0)), 1e-14);
}

TEST(Portable, SinglePrecisionIsTheRoundedDouble) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto x = static_cast<float>(std::pow(10.0, random.uniform(-6, 6)));
    const auto y = static_cast<float>(random.uniform(-80, 80));
    EXPECT_EQ(portable::log(x), static_cast<float>(std::log(static_cast<double>(x))));
    EXPECT_EQ(portable::exp(y), static_cast<float>(std::exp(static_cast<double>(y))));
    EXPECT_EQ(portable::asinh(-x), static_cast<float>(std::asinh(-static_cast<double>(x))));
  }
  EXPECT_EQ(portable::log(0.0F), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(portable::asinh(0.0F), 0.0F);
  EXPECT_TRUE(std::isnan(portable::log(-1.0F)));
  EXPECT_EQ(portable::log(1e-42F), std::log(1e-42F));
}

}  // namespace

}  // namespace kinemend
