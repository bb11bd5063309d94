// Evaluates and fits periodic curves, key curves and slow wandering.
#include "lab/synthesis/curves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::synth {

namespace {

using Row = std::array<double, 5>;

Row basis(double phase) {
  const double a = 4 * pi * phase;
  return {1, portable::cos(a), portable::sin(a), portable::cos(2 * a), portable::sin(2 * a)};
}

Row second_derivative_basis(double phase) {
  const double k = 4 * pi;
  Row row = basis(phase);
  row[0] = 0;
  row[1] *= -k * k;
  row[2] *= -k * k;
  row[3] *= -4 * k * k;
  row[4] *= -4 * k * k;
  return row;
}

// Solves by Gaussian elimination with row exchanges; the matrix is symmetric and positive definite.
Row solve(std::array<Row, 5> matrix, Row right) {
  for (std::size_t i = 0; i < 5; ++i) {
    std::size_t best = i;
    for (std::size_t r = i + 1; r < 5; ++r) {
      if (std::fabs(matrix[r][i]) > std::fabs(matrix[best][i])) best = r;
    }
    std::swap(matrix[i], matrix[best]);
    std::swap(right[i], right[best]);
    for (std::size_t r = i + 1; r < 5; ++r) {
      const double factor = matrix[r][i] / matrix[i][i];
      for (std::size_t c = i; c < 5; ++c) matrix[r][c] -= factor * matrix[i][c];
      right[r] -= factor * right[i];
    }
  }
  for (std::size_t i = 5; i-- > 0;) {
    for (std::size_t c = i + 1; c < 5; ++c) right[i] -= matrix[i][c] * right[c];
    right[i] /= matrix[i][i];
  }
  return right;
}

}  // namespace

double smoothstep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

double ramp(double value, double from, double to) {
  return smoothstep((value - from) / (to - from));
}

double smooth_hinge(double x, double width) {
  if (x <= -width) return 0;
  if (x >= width) return x;
  // This is the integral of smoothstep over [-width, x].
  const double u = (x + width) / (2 * width);
  return 2 * width * u * u * u * u * (2.5 + u * (-3 + u));
}

PeriodicCurve::PeriodicCurve(std::span<const double> samples) {
  const std::size_t count = samples.size();
  const std::size_t harmonics = (count - 1) / 2;
  cosines_.resize(harmonics);
  sines_.resize(harmonics);
  for (double v : samples) mean_ += v / static_cast<double>(count);
  for (std::size_t k = 0; k < harmonics; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      const double a = 2 * pi * static_cast<double>((k + 1) * i) / static_cast<double>(count);
      cosines_[k] += 2 * samples[i] * portable::cos(a) / static_cast<double>(count);
      sines_[k] += 2 * samples[i] * portable::sin(a) / static_cast<double>(count);
    }
  }
}

double PeriodicCurve::operator()(double phase) const {
  const double a = 2 * pi * (phase - std::floor(phase));
  const double c1 = portable::cos(a), s1 = portable::sin(a);
  double c = c1, s = s1, value = mean_;
  for (std::size_t k = 0; k < cosines_.size(); ++k) {
    value += cosines_[k] * c + sines_[k] * s;
    const double next = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = next;
  }
  return value;
}

double StepCurve::operator()(double phase) const {
  const Row row = basis(phase);
  double value = 0;
  for (std::size_t i = 0; i < 5; ++i) value += coefficients[i] * row[i];
  return value;
}

double StepCurve::periodic_integral(double phase) const {
  const auto& c = coefficients;
  const double k = 4 * pi, a = k * phase;
  return (c[1] * portable::sin(a) - c[2] * (portable::cos(a) - 1)) / k +
         (c[3] * portable::sin(2 * a) - c[4] * (portable::cos(2 * a) - 1)) / (2 * k);
}

StepCurve fit_step_curve(std::span<const StepEquation> equations, double ridge) {
  std::array<Row, 5> matrix{};
  for (std::size_t i = 1; i < 5; ++i) matrix[i][i] = ridge;
  Row right{};
  for (const StepEquation& e : equations) {
    const Row row = e.second_derivative ? second_derivative_basis(e.phase) : basis(e.phase);
    for (std::size_t i = 0; i < 5; ++i) {
      right[i] += e.weight * row[i] * e.value;
      for (std::size_t j = 0; j < 5; ++j) matrix[i][j] += e.weight * row[i] * row[j];
    }
  }
  return {solve(matrix, right)};
}

KeyCurve::KeyCurve(std::vector<Key> keys) : keys_(std::move(keys)) {}

double KeyCurve::operator()(double time) const {
  if (time <= keys_.front().time) return keys_.front().value;
  if (time >= keys_.back().time) return keys_.back().value;
  std::size_t i = 1;
  while (keys_[i].time < time) ++i;
  return quintic(keys_[i - 1], keys_[i], time);
}

double quintic(const Key& from, const Key& to, double time) {
  const double length = to.time - from.time;
  const double u = (time - from.time) / length;
  const double v0 = from.slope * length, v1 = to.slope * length;
  const double a0 = from.curvature * length * length, a1 = to.curvature * length * length;
  const double rise = to.value - from.value;
  const double c3 = 10 * rise - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
  const double c4 = -15 * rise + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
  const double c5 = 6 * rise - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1;
  return from.value + u * (v0 + u * (0.5 * a0 + u * (c3 + u * (c4 + u * c5))));
}

Wander::Wander(Random& random, double amplitude, double low_hz, double high_hz) {
  for (Wave& w : waves_) {
    w.amplitude = amplitude / std::sqrt(static_cast<double>(waves_.size()));
    w.frequency = random.uniform(low_hz, high_hz);
    w.phase = random.uniform();
  }
}

double Wander::operator()(double time) const {
  double value = 0;
  for (const Wave& w : waves_) {
    value += w.amplitude * portable::sin(2 * pi * (w.frequency * time + w.phase));
  }
  return value;
}

}  // namespace kinemend::synth
