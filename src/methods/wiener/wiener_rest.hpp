// Models the motion of a take outside the learned patterns, from the take itself.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinemend {

/// Model of a take's residual outside the learned patterns: independent coefficients whose variance
/// is estimated from the take itself and scaled for each window. The noise is scaled, too: a window
/// with a spike has more.
class RestModel {
 public:
  /// `prior`: D x M, learned variances; `noise`: D, of a coefficient. Channels come in threes,
  /// which share a scale.
  RestModel(const Eigen::MatrixXd& prior, const Eigen::VectorXd& noise, Eigen::Index frames,
            double window_s);

  /// Adds the residual coefficients (N x D) of a window. `counts`: D, 1 for measured channels.
  void add(const Eigen::MatrixXd& left, const Eigen::VectorXd& counts);
  /// Adds the sums of other windows of the take.
  void add(const RestModel& other);
  /// Sets the variances: those of the sums, less the noise and smoothed over frequency, where the
  /// prior has the weight of eight windows. `window_weight`: weight of a window, below 1 if windows
  /// overlap.
  void learn(double window_weight);
  /// Posterior means of the coefficients of a window (N x D), averaged over scales of the variances
  /// by their evidence, in place. The noise of a window is estimated from its highest frequencies.
  void shrink(Eigen::MatrixXd& left) const;

 private:
  struct Scale {
    Eigen::MatrixXd gain;         ///< N x D
    Eigen::MatrixXd precision;    ///< N x D
    Eigen::VectorXd log_density;  ///< D
  };
  int noise_octave(const Eigen::MatrixXd& left, Eigen::Index channel) const;

  Eigen::MatrixXd prior_;      // N x D
  Eigen::VectorXd noise_;      // D
  Eigen::Index motionless_;    // coefficients from here on are noise
  Eigen::MatrixXd signal_;     // N x D: sums of squares less their noise
  Eigen::VectorXd counts_;     // D
  std::vector<Scale> scales_;  // of the motion x of the noise
};

}  // namespace kinemend
