// Computes the filters of Daubechies wavelets and symlets.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "kinemend/experimental/signal.hpp"
#include "signal/checks.hpp"

namespace kinemend {

namespace {

using Real = long double;
using Complex = std::complex<Real>;

// Coefficients, lowest power first, of P(y) = sum_{k<N} binomial(N-1+k, k) y^k: with y = sin^2(w/2)
// the filter has |H|^2 = 2 cos^{2N}(w/2) P(y) (Daubechies 1988).
std::vector<Real> daubechies_polynomial(int moments) {
  std::vector<Real> coefficients = {1};
  for (int k = 1; k < moments; ++k) {
    coefficients.push_back(coefficients.back() * static_cast<Real>(moments - 1 + k) /
                           static_cast<Real>(k));
  }
  return coefficients;
}

// All roots at once (Durand-Kerner).
std::vector<Complex> roots_of(const std::vector<Real>& coefficients) {
  const std::size_t degree = coefficients.size() - 1;
  std::vector<Complex> roots(degree);
  for (std::size_t i = 0; i < degree; ++i)
    roots[i] = std::pow(Complex(0.4L, 0.9L), static_cast<Real>(i));
  for (int round = 0; round < 200; ++round) {
    for (std::size_t i = 0; i < degree; ++i) {
      Complex value = coefficients[degree];
      for (std::size_t k = degree; k-- > 0;) value = value * roots[i] + coefficients[k];
      Complex others = coefficients[degree];
      for (std::size_t j = 0; j < degree; ++j) {
        if (j != i) others *= roots[i] - roots[j];
      }
      roots[i] -= value / others;
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
    if (y.imag() < -1e-9L) continue;
    const Complex centre = Real(1) - Real(2) * y;
    const Complex offset = std::sqrt(centre * centre - Real(1));
    const Complex root = std::abs(centre - offset) < 1 ? centre - offset : centre + offset;
    groups.push_back(std::abs(y.imag()) <= 1e-9L ? Complex(root.real(), 0) : root);
  }
  return groups;
}

// h(z) = (1 + 1/z)^N prod (1 - root/z), scaled to sum sqrt(2).
std::vector<Real> filter_from_roots(int moments, const std::vector<Complex>& groups) {
  std::vector<Real> h = {1};
  const auto multiply = [&h](std::initializer_list<Real> factor) {
    std::vector<Real> product(h.size() + factor.size() - 1, 0);
    for (std::size_t i = 0; i < h.size(); ++i) {
      std::size_t j = i;
      for (const Real f : factor) product[j++] += h[i] * f;
    }
    h = product;
  };
  for (int k = 0; k < moments; ++k) multiply({1, 1});
  for (const Complex& root : groups) {
    if (root.imag() == 0) {
      multiply({1, -root.real()});
    } else {
      multiply({1, -2 * root.real(), std::norm(root)});
    }
  }
  Real sum = 0;
  for (const Real value : h) sum += value;
  for (Real& value : h) value *= std::numbers::sqrt2_v<Real> / sum;
  return h;
}

// Deviation of the phase from a straight line between 0 and pi, the (1 + 1/z)^N factor, whose phase
// is linear, left out.
Real phase_nonlinearity(const std::vector<Complex>& groups) {
  // Of the frequency. Chosen by hand, not swept: only the least of all counts.
  constexpr int steps = 256;
  std::vector<Real> phase(steps + 1, 0);
  for (int i = 0; i <= steps; ++i) {
    const Real w = std::numbers::pi_v<Real> * static_cast<Real>(i) / steps;
    const Complex delay = std::polar(Real(1), -w);
    Complex value = 1;
    for (const Complex& root : groups) {
      value *= Real(1) - root * delay;
      if (root.imag() != 0) value *= Real(1) - std::conj(root) * delay;
    }
    Real angle = std::arg(value);
    if (i > 0) {
      const Real turn = 2 * std::numbers::pi_v<Real>;
      angle += turn * std::round((phase[static_cast<std::size_t>(i) - 1] - angle) / turn);
    }
    phase[static_cast<std::size_t>(i)] = angle;
  }
  Real sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Real difference =
        phase[k] - phase[0] - (phase[steps] - phase[0]) * static_cast<Real>(i) / steps;
    sum += difference * difference;
  }
  return sum;
}

Real centre_of_energy(const std::vector<Real>& h) {
  Real sum = 0;
  for (std::size_t k = 0; k < h.size(); ++k) sum += static_cast<Real>(k) * h[k] * h[k];
  return sum;
}

// Of all choices of roots the one nearest to linear phase; of it and its mirror image the one that
// comes earlier.
std::vector<Real> least_asymmetric_filter(int moments, const std::vector<Complex>& groups) {
  std::vector<Complex> best;
  Real least = 0;
  for (std::size_t choice = 0; choice < (std::size_t{1} << (groups.size() - 1)); ++choice) {
    std::vector<Complex> chosen = groups;
    for (std::size_t k = 0; k + 1 < groups.size(); ++k) {
      if ((choice >> k) & 1) chosen[k] = Real(1) / std::conj(groups[k]);
    }
    const Real nonlinearity = phase_nonlinearity(chosen);
    if (best.empty() || nonlinearity < least) {
      least = nonlinearity;
      best = chosen;
    }
  }
  std::vector<Real> h = filter_from_roots(moments, best);
  if (centre_of_energy(h) > static_cast<Real>(h.size() - 1) / 2) std::reverse(h.begin(), h.end());
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
  return {h.begin(), h.end()};
}

}  // namespace kinemend
