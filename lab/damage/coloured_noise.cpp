// Sums random harmonics by an inverse Fourier transform, and integrates slow noise into paths.
#include "lab/damage/coloured_noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>

#include "base/portable.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend::corrupt {

namespace {

using Complex = std::complex<double>;

// Returns the integral of (1 + x^2)^(-slope / 2) over x >= 0.
double shape_integral(double slope) {
  return std::sqrt(pi) / 2 * portable::tgamma((slope - 1) / 2) / portable::tgamma(slope / 2);
}

// Computes sum_k x_k exp(2 pi i k n / N) in place; N is a power of two (Cooley and Tukey, radix 2).
void inverse_transform(std::vector<Complex>& x) {
  const std::size_t size = x.size();
  for (std::size_t i = 1, j = 0; i < size; ++i) {
    std::size_t bit = size >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  std::vector<Complex> turns(size / 2);
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(size);
    const auto [sine, cosine] = portable::sine_and_cosine(angle);
    turns[k] = {cosine, sine};
  }
  for (std::size_t length = 2; length <= size; length *= 2) {
    const std::size_t half = length / 2, step = size / length;
    for (std::size_t first = 0; first < size; first += length) {
      for (std::size_t k = 0; k < half; ++k) {
        const Complex turn = turns[k * step], odd = x[first + k + half];
        // This is written out because operator* of std::complex tests for infinities.
        const Complex turned{odd.real() * turn.real() - odd.imag() * turn.imag(),
                             odd.real() * turn.imag() + odd.imag() * turn.real()};
        x[first + k + half] = x[first + k] - turned;
        x[first + k] += turned;
      }
    }
  }
}

// The period exceeds the take by the correlation time of the noise, because its end resembles its
// beginning.
std::size_t period_frames(NoiseShape shape, std::size_t frames, double rate_hz) {
  const double least = static_cast<double>(frames) + rate_hz / shape.corner_hz;
  return std::bit_ceil(static_cast<std::size_t>(std::max(2.0, std::ceil(least))));
}

}  // namespace

double noise_density(NoiseShape shape, double frequency_hz) {
  const double x = frequency_hz / shape.corner_hz;
  return portable::pow(1 + x * x, -shape.slope / 2) /
         (shape.corner_hz * shape_integral(shape.slope));
}

std::vector<double> coloured_noise(NoiseShape shape, std::size_t frames, double rate_hz,
                                   const Random& random) {
  std::vector<double> noise(frames);
  if (frames == 0) return noise;
  const double counted_hz = window_rate_hz(rate_hz);
  const std::size_t period = period_frames(shape, frames, counted_hz);
  const double step_hz = counted_hz / static_cast<double>(period);
  Random own = random;
  std::vector<Complex> harmonics(period);
  for (std::size_t k = 0; k <= period / 2; ++k) {
    // Harmonic k represents a band one step wide around it; half of the first and last band lies
    // within [0, rate / 2].
    const bool is_end = k == 0 || k == period / 2;
    const double variance =
        noise_density(shape, static_cast<double>(k) * step_hz) * step_hz * (is_end ? 0.5 : 1.0);
    const double deviation = std::sqrt(variance);
    const double cosine = deviation * own.normal(), sine = deviation * own.normal();
    harmonics[k] = {cosine, is_end ? 0.0 : -sine};
  }
  inverse_transform(harmonics);
  for (std::size_t f = 0; f < frames; ++f) noise[f] = harmonics[f].real();
  return noise;
}

std::vector<Vec3> coloured_vectors(NoiseShape shape, std::size_t frames, double rate_hz,
                                   const Random& random) {
  std::vector<Vec3> noise(frames);
  double Vec3::*const axes[] = {&Vec3::x, &Vec3::y, &Vec3::z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto values = coloured_noise(shape, frames, rate_hz, random.fork(axis));
    for (std::size_t f = 0; f < frames; ++f) noise[f].*axes[axis] = values[f];
  }
  return noise;
}

std::vector<double> random_path(std::size_t frames, double rate_hz, const Random& random) {
  // The velocities persist for some seconds, like those of a heading that a magnetometer corrects.
  // The corner of 0.2 Hz and the slope are chosen by hand, not swept.
  constexpr NoiseShape velocity{0.2, 4};
  // The variance of the integral of noise with density S(0) at 0 Hz grows by S(0) / 2 a second.
  const double scale = std::sqrt(2 / (60 * noise_density(velocity, 0)));
  std::vector<double> path = coloured_noise(velocity, frames, rate_hz, random);
  double place = 0;
  for (double& value : path) {
    const double step = scale * value / rate_hz;
    value = place;
    place += step;
  }
  return path;
}

}  // namespace kinemend::corrupt
