// Kalman filter and Rauch-Tung-Striebel smoother of one track of rotations or points. The state is
// the sample x and its velocity w (rotations: in the joint's own frame), the error state a vector
// of three and its rate. Noise is isotropic, so that one 2 x 2 covariance serves each of the three
// axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kinemend/extend/rotation.hpp"

namespace kinemend {

struct KalmanModel {
  bool with_velocity = true;
  double frame_step_s = 1.0 / 120;
  /// Spectral density of the white acceleration (rad^2 / s^3), or of the white velocity (rad^2 / s)
  /// of the position model; for points in their unit instead of rad.
  double process_density = 1;
};

/// Covariance of one axis: of the sample, of sample and velocity, of the velocity.
struct Covariance {
  double xx = 0, xv = 0, vv = 0;
};

template <class Sample>
struct TrackState {
  Sample x;
  Vec3 velocity;
  Covariance covariance;
};

inline Vec3 minus(Quat a, Quat b) { return log(conjugate(b) * a); }
inline Vec3 minus(Vec3 a, Vec3 b) { return a - b; }
inline Quat plus(Quat a, Vec3 v) { return normalized(a * exp(v)); }
inline Vec3 plus(Vec3 a, Vec3 v) { return a + v; }
/// Transforms an error from the frame of x advanced by `step` to the frame of x.
inline Vec3 carried_back(Quat, Vec3 error, Vec3 step) { return rotate(exp(step), error); }
inline Vec3 carried_back(Vec3, Vec3 error, Vec3) { return error; }

/// The state at a first sample. The velocity has a deviation of 100 rad / s times `scale`.
template <class Sample>
TrackState<Sample> start_state(Sample sample, double noise, double scale) {
  return {sample, {}, {noise * noise, 0, 1e4 * scale * scale}};
}

template <class Sample>
TrackState<Sample> predict(const TrackState<Sample>& state, const KalmanModel& model) {
  const double dt = model.frame_step_s, q = model.process_density;
  const Covariance& p = state.covariance;
  if (!model.with_velocity) return {state.x, {}, {p.xx + q * dt, 0, 0}};
  return {plus(state.x, dt * state.velocity),
          state.velocity,
          {p.xx + 2 * dt * p.xv + dt * dt * p.vv + q * dt * dt * dt / 3,
           p.xv + dt * p.vv + q * dt * dt / 2, p.vv + q * dt}};
}

/// Updates the state by a measured sample. `variance` is that of one axis.
template <class Sample>
void update(TrackState<Sample>& state, Sample measured, double variance) {
  Covariance& p = state.covariance;
  const double total = p.xx + variance;
  if (!(total > 0)) return;
  const double gain = p.xx / total, velocity_gain = p.xv / total;
  const Vec3 innovation = minus(measured, state.x);
  state.x = plus(state.x, gain * innovation);
  state.velocity += velocity_gain * innovation;
  p = {(1 - gain) * p.xx, (1 - gain) * p.xv, p.vv - velocity_gain * p.xv};
}

/// The smoothed sample and velocity at t from the filtered state at t, the prediction made from it
/// and the smoothed state at t + 1.
template <class Sample>
void smooth_back(TrackState<Sample>& filtered, const TrackState<Sample>& predicted,
                 const TrackState<Sample>& next, const KalmanModel& model) {
  const Covariance &p = filtered.covariance, &ahead = predicted.covariance;
  const double dt = model.frame_step_s;
  const Vec3 error = carried_back(filtered.x, minus(next.x, predicted.x), dt * filtered.velocity);
  if (!model.with_velocity) {
    if (ahead.xx > 0) filtered.x = plus(filtered.x, (p.xx / ahead.xx) * error);
    return;
  }
  const double determinant = ahead.xx * ahead.vv - ahead.xv * ahead.xv;
  if (!(determinant > 0)) return;
  // G = P F^T P_ahead^-1 with F = (1 dt; 0 1).
  const double a = p.xx + dt * p.xv, b = p.xv, c = p.xv + dt * p.vv, d = p.vv;
  const Vec3 rate_error = next.velocity - predicted.velocity;
  const auto row = [&](double left, double right) {
    const double first = (left * ahead.vv - right * ahead.xv) / determinant;
    const double second = (right * ahead.xx - left * ahead.xv) / determinant;
    return first * error + second * rate_error;
  };
  const Vec3 shift = row(a, b), rate_shift = row(c, d);
  filtered.x = plus(filtered.x, shift);
  filtered.velocity += rate_shift;
}

/// Smooths a whole track. `observed`: one mark per sample, empty means all; the others are filled.
/// A track without an observed sample is unchanged.
template <class Sample>
std::vector<Sample> kalman_smooth(std::span<const Sample> track,
                                  std::span<const std::uint8_t> observed, double noise,
                                  double scale, const KalmanModel& model) {
  const auto seen = [&](std::size_t t) { return observed.empty() || observed[t] != 0; };
  std::size_t first = 0;
  while (first < track.size() && !seen(first)) ++first;
  std::vector<Sample> result(track.begin(), track.end());
  if (first == track.size()) return result;

  const std::size_t count = track.size() - first;
  std::vector<TrackState<Sample>> filtered(count), predicted(count);
  filtered[0] = start_state(track[first], noise, scale);
  for (std::size_t i = 1; i < count; ++i) {
    predicted[i] = filtered[i] = predict(filtered[i - 1], model);
    if (seen(first + i)) update(filtered[i], track[first + i], noise * noise);
  }
  for (std::size_t i = count - 1; i > 0; --i) {
    smooth_back(filtered[i - 1], predicted[i], filtered[i], model);
  }
  for (std::size_t t = 0; t < track.size(); ++t) {
    result[t] = filtered[t < first ? 0 : t - first].x;
  }
  return result;
}

}  // namespace kinemend
