#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinemend {

/// What the learned patterns leave of a take, as independent coefficients whose variance is learned
/// from the take itself and scaled window by window: quick moments and slow ones differ. So does
/// the noise: a window may have more of it than the take, as where there is a spike.
class RestModel {
 public:
  /// `prior`: D x M, what was learned; `noise`: D, of a coefficient. Channels come in threes, which
  /// share a scale.
  RestModel(const Eigen::MatrixXd& prior, const Eigen::VectorXd& noise, Eigen::Index frames,
            double window_s);

  /// Adds the coefficients (N x D) that a window leaves. `counts`: D, 1 for channels that were
  /// measured.
  void add(const Eigen::MatrixXd& left, const Eigen::VectorXd& counts);
  /// Sums of another part of the take.
  void add(const RestModel& other);
  /// Sets the variances: those of the sums, less the noise and smoothed over frequency, where the
  /// prior is worth eight windows. `window_weight`: what a window counts, less than 1 where windows
  /// overlap.
  void learn(double window_weight);
  /// Posterior means of the coefficients of a window (N x D), averaged over scales of the variances
  /// by their evidence, in place. The noise of a window is told by its highest frequencies.
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
