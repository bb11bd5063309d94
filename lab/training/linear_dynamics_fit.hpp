// Learns motion as a linear dynamical system from clips (Lou & Chai 2010, section 4.2).
#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "classic/linear_dynamics.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

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

}  // namespace kinemend
