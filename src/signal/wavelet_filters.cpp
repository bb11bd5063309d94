// Computes the filters of Daubechies wavelets and symlets.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/double_double.hpp"
#include "base/portable.hpp"
#include "kinemend/experimental/signal.hpp"
#include "signal/checks.hpp"

namespace kinemend {

namespace {

// A double would lose the last digits of the roots, and long double is another number elsewhere.
using Real = DoubleDouble;

Real real(double value) { return {value}; }
Real real(int value) { return {static_cast<double>(value)}; }
Real real(std::size_t value) { return {static_cast<double>(value)}; }

struct Complex {
  Real re{}, im{};
};

Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
Complex operator*(const Complex& a, const Complex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Complex conjugate(const Complex& a) { return {a.re, -a.im}; }
Real square_size(const Complex& a) { return a.re * a.re + a.im * a.im; }
Complex operator/(const Complex& a, const Complex& b) {
  const Complex product = a * conjugate(b);
  const Real size = square_size(b);
  return {product.re / size, product.im / size};
}

Complex square_root(const Complex& a) {
  const Real size = square_root(square_size(a));
  const Real longer = square_root((size + (a.re.hi < 0 ? -a.re : a.re)) * real(0.5));
  if (longer.hi == 0) return {};
  const Real shorter = a.im / (longer + longer);
  return a.re.hi < 0 ? Complex{shorter, longer} : Complex{longer, shorter};
}

// Coefficients, lowest power first, of P(y) = sum_{k<N} binomial(N-1+k, k) y^k: with y = sin^2(w/2)
// the filter has |H|^2 = 2 cos^{2N}(w/2) P(y) (Daubechies 1988).
std::vector<Real> daubechies_polynomial(int moments) {
  std::vector<Real> coefficients = {real(1)};
  for (int k = 1; k < moments; ++k) {
    coefficients.push_back(coefficients.back() * real(moments - 1 + k) / real(k));
  }
  return coefficients;
}

// All roots at once (Durand-Kerner).
std::vector<Complex> roots_of(const std::vector<Real>& coefficients) {
  const std::size_t degree = coefficients.size() - 1;
  std::vector<Complex> roots(degree);
  for (std::size_t i = 0; i < degree; ++i)
    roots[i] = i == 0 ? Complex{real(1)} : roots[i - 1] * Complex{real(0.4), real(0.9)};
  for (int round = 0; round < 200; ++round) {
    for (std::size_t i = 0; i < degree; ++i) {
      Complex value{coefficients[degree]};
      for (std::size_t k = degree; k-- > 0;) value = value * roots[i] + Complex{coefficients[k]};
      Complex others{coefficients[degree]};
      for (std::size_t j = 0; j < degree; ++j) {
        if (j != i) others = others * (roots[i] - roots[j]);
      }
      roots[i] = roots[i] - value / others;
    }
  }
  return roots;
}

// The roots in z of y = (2 - z - 1/z) / 4 inside the unit circle, grouped: a real root alone, a
// complex one together with its conjugate. Taking 1/z instead of z for a group does not change
// |H|.
std::vector<Complex> root_groups(int moments) {
  std::vector<Complex> groups;
  for (const Complex& y : roots_of(daubechies_polynomial(moments))) {
    if (y.im.hi < -1e-9) continue;
    const Complex centre = Complex{real(1)} - (y + y);
    const Complex offset = square_root(centre * centre - Complex{real(1)});
    const Complex root = square_size(centre - offset).hi < 1 ? centre - offset : centre + offset;
    groups.push_back(std::fabs(y.im.hi) <= 1e-9 ? Complex{root.re} : root);
  }
  return groups;
}

// h(z) = (1 + 1/z)^N prod (1 - root/z), scaled to sum sqrt(2).
std::vector<Real> filter_from_roots(int moments, const std::vector<Complex>& groups) {
  std::vector<Real> h = {real(1)};
  const auto multiply = [&h](std::initializer_list<Real> factor) {
    std::vector<Real> product(h.size() + factor.size() - 1);
    for (std::size_t i = 0; i < h.size(); ++i) {
      std::size_t j = i;
      for (const Real f : factor) {
        product[j] = product[j] + h[i] * f;
        ++j;
      }
    }
    h = product;
  };
  for (int k = 0; k < moments; ++k) multiply({real(1), real(1)});
  for (const Complex& root : groups) {
    if (root.im.hi == 0) {
      multiply({real(1), -root.re});
    } else {
      multiply({real(1), -(root.re + root.re), square_size(root)});
    }
  }
  Real sum;
  for (const Real value : h) sum = sum + value;
  const Real scale = square_root(real(2)) / sum;
  for (Real& value : h) value = value * scale;
  return h;
}

// Deviation of the phase from a straight line between 0 and pi, the (1 + 1/z)^N factor, whose phase
// is linear, left out.
double phase_nonlinearity(const std::vector<Complex>& groups) {
  // Of the frequency. Chosen by hand, not swept: only the least of all counts.
  constexpr int steps = 256;
  std::vector<double> phase(steps + 1, 0);
  for (int i = 0; i <= steps; ++i) {
    const auto [sine, cosine] = portable::sine_and_cosine(-std::numbers::pi * i / steps);
    const std::complex<double> delay(cosine, sine);
    std::complex<double> value = 1;
    for (const Complex& group : groups) {
      const std::complex<double> root(group.re.hi, group.im.hi);
      value *= 1.0 - root * delay;
      if (root.imag() != 0) value *= 1.0 - std::conj(root) * delay;
    }
    double angle = portable::atan2(value.imag(), value.real());
    if (i > 0) {
      const double turn = 2 * std::numbers::pi;
      angle += turn * std::round((phase[static_cast<std::size_t>(i) - 1] - angle) / turn);
    }
    phase[static_cast<std::size_t>(i)] = angle;
  }
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double difference = phase[k] - phase[0] - (phase[steps] - phase[0]) * i / steps;
    sum += difference * difference;
  }
  return sum;
}

double centre_of_energy(const std::vector<Real>& h) {
  Real sum;
  for (std::size_t k = 0; k < h.size(); ++k) sum = sum + real(k) * h[k] * h[k];
  return sum.hi;
}

// Of all choices of roots the one nearest to linear phase; of it and its mirror image the one that
// comes earlier.
std::vector<Real> least_asymmetric_filter(int moments, const std::vector<Complex>& groups) {
  std::vector<Complex> best;
  double least = 0;
  for (std::size_t choice = 0; choice < (std::size_t{1} << (groups.size() - 1)); ++choice) {
    std::vector<Complex> chosen = groups;
    for (std::size_t k = 0; k + 1 < groups.size(); ++k) {
      if ((choice >> k) & 1) chosen[k] = Complex{real(1)} / conjugate(groups[k]);
    }
    const double nonlinearity = phase_nonlinearity(chosen);
    if (best.empty() || nonlinearity < least) {
      least = nonlinearity;
      best = chosen;
    }
  }
  std::vector<Real> h = filter_from_roots(moments, best);
  if (centre_of_energy(h) > static_cast<double>(h.size() - 1) / 2) std::reverse(h.begin(), h.end());
  return h;
}

}  // namespace

std::vector<double> wavelet_filter(WaveletFamily family, int vanishing_moments) {
  const bool symlet = family == WaveletFamily::symlet;
  const int fewest = symlet ? 2 : 1;
  signal::require(
      vanishing_moments >= fewest && vanishing_moments <= 10,
      fmt::format("{} vanishing moments are outside {} to 10", vanishing_moments, fewest));
  const std::vector<Complex> groups = root_groups(vanishing_moments);
  const std::vector<Real> h = symlet ? least_asymmetric_filter(vanishing_moments, groups)
                                     : filter_from_roots(vanishing_moments, groups);
  std::vector<double> coefficients;
  for (const Real value : h) coefficients.push_back(value.hi);
  return coefficients;
}

}  // namespace kinemend
