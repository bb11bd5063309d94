// Kalman filter and smoother of a linear dynamical system.
#pragma once

#include <cstdint>
#include <span>

#include "classic/linear_dynamics.hpp"
#include "kinemend/experimental/pose_matrix.hpp"

namespace kinemend {

/// The measurements in a pose matrix.
struct MeasurementFacts {
  std::span<const std::uint8_t> observed;  ///< F x D, 0 where missing; empty: all observed
  /// D, standard deviations in degrees, at least 0 (raised to 1e-3).
  std::span<const double> noise_deg;
};

/// Replaces each frame by its expectation given the frames up to it (Kalman 1960). The dynamics are
/// at the rate of the poses (`at_rate`).
void filter_with_dynamics(PoseMatrix& poses, const MeasurementFacts& facts,
                          const LinearDynamics& dynamics);

/// Replaces each frame by its expectation given all frames, by a second pass over the filter's
/// (Bryson & Frazier 1963, which inverts no covariance). The cost is linear in frames; gains are
/// recomputed until they converge, after each change of the observed channels.
void smooth_with_dynamics(PoseMatrix& poses, const MeasurementFacts& facts,
                          const LinearDynamics& dynamics);

}  // namespace kinemend
