// Learns motion as a linear dynamical system from clips (Lou & Chai 2010, section 4.2), and filters
// and smooths motion with it.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>

#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/model.hpp"

namespace kinemend {

/// A linear model of poses at `rate_hz`, driven by white noise. With the channels less their mean,
/// in a subspace of K directions, z_t = U^T (x_t - m), and the state s_t of the last `order` of
/// them (K or 2 K numbers, the newest first):
///
///     s_{t+1} = A s_t + w,  w ~ N(0, Q),      y_t = m + U z_t + v,  v ~ N(0, R)
///
/// Units are those of the channels (degrees); R belongs to the measurement.
struct LinearDynamics {
  double rate_hz = 30;
  std::size_t order = 1;       ///< 1 (the paper's) or 2
  Eigen::VectorXd mean;        ///< D
  Eigen::MatrixXd basis;       ///< D x K with orthonormal columns; empty: all channels, U = I
  Eigen::VectorXd outside;     ///< D: variance outside the subspace; added to R
  Eigen::MatrixXd transition;  ///< A
  Eigen::MatrixXd drive;       ///< Q
  Eigen::MatrixXd spread;      ///< covariance of the initial state

  Eigen::Index channels() const { return mean.size(); }
  Eigen::Index directions() const { return basis.size() == 0 ? mean.size() : basis.cols(); }
  Eigen::Index states() const { return transition.rows(); }
};

struct LinearDynamicsSettings {
  double rate_hz = 30;         ///< of the sequences
  std::size_t order = 1;       ///< 1 or 2
  double ridge = 1e-4;         ///< added to each variance, relative to it
  std::size_t directions = 0;  ///< K; 0: all channels
};

/// Fits A and Q by least squares from second moments of neighbouring poses, accumulated in one
/// pass: memory depends on the number of channels only.
class LinearDynamicsFit {
 public:
  LinearDynamicsFit(std::size_t channels, std::size_t order);
  /// Sequences shorter than order + 1 frames are ignored.
  void add(const PoseMatrix& poses, double weight = 1);
  double transitions() const noexcept { return weight_; }
  /// A is scaled to a spectral radius below 1. Errors: `ErrorKind::usage` if there was no
  /// transition.
  LinearDynamics finish(const LinearDynamicsSettings& settings) const;

 private:
  // Moments of the stacked poses about `offset`, which all lags share.
  Eigen::MatrixXd central_moments(const Eigen::VectorXd& offset) const;

  std::size_t channels_, order_;
  double weight_ = 0;
  Eigen::VectorXd shift_;    // D: near the mean, for numerical accuracy
  Eigen::VectorXd sums_;     // (order + 1) D
  Eigen::MatrixXd moments_;  // of the stacked poses, newest first; lower half
};

/// The same motion at another rate: A(h) = A^h with h = rate_hz of the model over `rate_hz`, and
/// the drive that keeps the stationary covariance, Q(h) = S - A(h) S A(h)^T with S = A S A^T + Q:
/// m steps of 1 / m equal one. Directions without such a root, which change sign from frame to
/// frame, get a transition of 0.
LinearDynamics at_rate(const LinearDynamics& dynamics, double rate_hz);

/// Convert to and from tensors of the model file. Errors: `ErrorKind::unreadable_input` naming the
/// inconsistent tensor.
void store_dynamics(const LinearDynamics& dynamics, Model& model);
LinearDynamics dynamics_of(const Model& model);

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
