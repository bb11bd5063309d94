// Figures of a series of errors by their definitions, for tests and the noise page.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kinemend/extend/rotation.hpp"

namespace kinemend::test {

inline double mean_of(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v;
  return x.empty() ? 0 : sum / static_cast<double>(x.size());
}

/// Variance about the mean.
inline double variance_of(const std::vector<double>& x) {
  const double mean = mean_of(x);
  double sum = 0;
  for (const double v : x) sum += (v - mean) * (v - mean);
  return x.empty() ? 0 : sum / static_cast<double>(x.size());
}

inline double deviation_of(const std::vector<double>& x) { return std::sqrt(variance_of(x)); }

/// Fourth moment over the squared variance: 3 of Gaussian noise.
inline double kurtosis_of(const std::vector<double>& x) {
  const double mean = mean_of(x), variance = variance_of(x);
  double sum = 0;
  for (const double v : x) sum += std::pow(v - mean, 4);
  return sum / static_cast<double>(x.size()) / (variance * variance);
}

inline double correlation_of(const std::vector<double>& x, const std::vector<double>& y) {
  const double mean_x = mean_of(x), mean_y = mean_of(y);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - mean_x) * (y[i] - mean_y);
  return sum / static_cast<double>(x.size()) / std::sqrt(variance_of(x) * variance_of(y));
}

/// Autocorrelation at `lag` samples; the sum over the existing pairs is divided by the full length.
inline double autocorrelation(const std::vector<double>& x, std::size_t lag) {
  const double mean = mean_of(x);
  double sum = 0;
  for (std::size_t i = lag; i < x.size(); ++i) sum += (x[i] - mean) * (x[i - lag] - mean);
  return sum / static_cast<double>(x.size()) / variance_of(x);
}

/// One-sided density (1/Hz) at frequency k * `step_hz`.
struct Spectrum {
  double step_hz = 0;
  std::vector<double> density;
  /// Variance between two frequencies, including the first.
  double between(double low_hz, double high_hz) const {
    double sum = 0;
    for (std::size_t k = 0; k < density.size(); ++k) {
      const double f = step_hz * static_cast<double>(k);
      if (f >= low_hz && f < high_hz) sum += density[k] * step_hz;
    }
    return sum;
  }
};

/// Welch's method: the mean periodogram of half-overlapping segments with a Hann window. A segment
/// has `segment` samples (at most the series), and its mean is removed.
inline Spectrum welch(const std::vector<double>& x, double rate_hz, std::size_t segment) {
  segment = std::min(segment, x.size());
  Spectrum spectrum;
  spectrum.step_hz = rate_hz / static_cast<double>(segment);
  spectrum.density.assign(segment / 2 + 1, 0.0);
  std::vector<double> window(segment), cosines(segment), sines(segment), part(segment);
  double power = 0;
  for (std::size_t i = 0; i < segment; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(segment);
    cosines[i] = std::cos(angle);
    sines[i] = std::sin(angle);
    window[i] = 0.5 - 0.5 * cosines[i];
    power += window[i] * window[i];
  }
  std::size_t count = 0;
  for (std::size_t first = 0; first + segment <= x.size(); first += (segment + 1) / 2, ++count) {
    double mean = 0;
    for (std::size_t i = 0; i < segment; ++i) mean += x[first + i] / static_cast<double>(segment);
    for (std::size_t i = 0; i < segment; ++i) part[i] = window[i] * (x[first + i] - mean);
    for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
      double real = 0, imaginary = 0;
      for (std::size_t i = 0, turn = 0; i < segment; ++i) {
        real += part[i] * cosines[turn];
        imaginary += part[i] * sines[turn];
        turn += k;
        if (turn >= segment) turn -= segment;
      }
      const double square = real * real + imaginary * imaginary;
      const bool is_end = k == 0 || 2 * k == segment;
      spectrum.density[k] += (is_end ? 1 : 2) * square / (power * rate_hz);
    }
  }
  for (double& density : spectrum.density) density /= static_cast<double>(count);
  return spectrum;
}

}  // namespace kinemend::test
