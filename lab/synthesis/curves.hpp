// Smooth functions of time and phase from which motions are made.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend::synth {

/// Returns 0 below 0 and 1 above 1, with two continuous derivatives: 6u^5 - 15u^4 + 10u^3.
double smoothstep(double u);
/// Returns smoothstep over [from, to]; it falls if to < from.
double ramp(double value, double from, double to);
/// Returns 0 below -width and x above width, with two continuous derivatives between.
double smooth_hinge(double x, double width);

/// A periodic function through equally spaced samples of one cycle: their trigonometric
/// interpolation, which has all derivatives.
class PeriodicCurve {
 public:
  explicit PeriodicCurve(std::span<const double> samples);
  /// `phase` in cycles, any value.
  double operator()(double phase) const;

 private:
  double mean_ = 0;
  std::vector<double> cosines_, sines_;
};

/// a0 + a1 cos(4 pi p) + b1 sin(4 pi p) + a2 cos(8 pi p) + b2 sin(8 pi p): a curve of the whole
/// body, where p is the phase of the stride. Both steps of the stride are alike.
struct StepCurve {
  std::array<double, 5> coefficients{};

  double operator()(double phase) const;
  /// Returns the integral from 0 without the mean, whose share grows.
  double periodic_integral(double phase) const;
  double mean() const { return coefficients[0]; }
};

/// One equation of a least-squares fit of a StepCurve: the value, or the second derivative, at a
/// phase.
struct StepEquation {
  double phase = 0, value = 0, weight = 1;
  bool second_derivative = false;
};
/// `ridge` pulls the four oscillating coefficients towards 0, as that many equations of weight 1
/// would.
StepCurve fit_step_curve(std::span<const StepEquation> equations, double ridge = 0);

/// A point that a KeyCurve passes with a given slope and curvature.
struct Key {
  double time = 0, value = 0, slope = 0, curvature = 0;
};

/// Quintic pieces between keys with two continuous derivatives; constant before the first and after
/// the last key.
class KeyCurve {
 public:
  explicit KeyCurve(std::vector<Key> keys);
  double operator()(double time) const;

 private:
  std::vector<Key> keys_;
};

/// Returns the quintic through both keys at `time`.
double quintic(const Key& from, const Key& to, double time);

/// A slow, bounded wandering: a sum of sinusoids of random frequency and phase.
class Wander {
 public:
  /// |value| stays below about 2 x `amplitude`, whose square is twice the mean square.
  Wander(Random& random, double amplitude, double low_hz, double high_hz);
  double operator()(double time) const;

 private:
  struct Wave {
    double amplitude, frequency, phase;
  };
  std::array<Wave, 5> waves_{};
};

}  // namespace kinemend::synth
