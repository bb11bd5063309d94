// Random linear dynamics and motion from them, for tests.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "classic/linear_dynamics.hpp"
#include "dense_algebra.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::test {

inline Eigen::MatrixXd random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = random.normal();
  return matrix;
}

/// Damped rotations in random planes: eigenvalues `size` exp(+-i angle) with angles below 0.5.
inline Eigen::MatrixXd random_turning(Random& random, Eigen::Index n, double size) {
  Eigen::MatrixXd turning = Eigen::MatrixXd::Identity(n, n) * size;
  for (Eigen::Index i = 0; i + 1 < n; i += 2) {
    const double angle = 0.1 + 0.4 * random.uniform();
    turning.block(i, i, 2, 2) << size * std::cos(angle), -size * std::sin(angle),
        size * std::sin(angle), size * std::cos(angle);
  }
  const Eigen::MatrixXd mix = Eigen::MatrixXd::Identity(n, n) + 0.2 * random_matrix(random, n, n);
  return mix * turning * inverse(mix);
}

inline Eigen::MatrixXd random_covariance(Random& random, Eigen::Index n) {
  const Eigen::MatrixXd factor = random_matrix(random, n, n);
  return factor * factor.transpose() / static_cast<double>(n) +
         0.1 * Eigen::MatrixXd::Identity(n, n);
}

/// S = A S A^T + Q, summed over all past steps.
inline Eigen::MatrixXd long_run_spread(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q) {
  Eigen::MatrixXd spread = q, left = q;
  for (int i = 0; i < 5000; ++i) {
    left = (a * left * a.transpose()).eval();
    spread += left;
  }
  return spread;
}

/// First-order dynamics of all channels.
inline LinearDynamics random_dynamics(Random& random, Eigen::Index channels) {
  LinearDynamics dynamics;
  dynamics.mean = 10 * random_matrix(random, channels, 1);
  dynamics.outside = Eigen::VectorXd::Zero(channels);
  dynamics.transition = random_turning(random, channels, 0.95);
  dynamics.drive = random_covariance(random, channels);
  dynamics.spread = long_run_spread(dynamics.transition, dynamics.drive);
  return dynamics;
}

/// Simulates motion of the dynamics without measurement noise.
inline PoseMatrix simulate(const LinearDynamics& dynamics, std::size_t frames, Random& random) {
  const Eigen::Index n = dynamics.states();
  const Eigen::MatrixXd first = root_of(dynamics.spread);
  const Eigen::MatrixXd step = root_of(dynamics.drive);
  PoseMatrix poses(frames, static_cast<std::size_t>(dynamics.channels()));
  Eigen::VectorXd state = first * random_matrix(random, n, 1);
  for (std::size_t f = 0; f < frames; ++f) {
    if (f > 0) {
      const Eigen::VectorXd push = step * random_matrix(random, n, 1);
      state = (dynamics.transition * state + push).eval();
    }
    const Eigen::VectorXd seen = state.head(dynamics.directions());
    Eigen::Map<Eigen::VectorXd>(poses.row(f).data(), dynamics.channels()) =
        dynamics.mean + (dynamics.basis.size() == 0 ? seen : dynamics.basis * seen);
  }
  return poses;
}

}  // namespace kinemend::test
