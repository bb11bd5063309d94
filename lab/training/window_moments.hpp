// Means, covariances and leading directions of many windows.
#pragma once

#include <Eigen/Core>

namespace kinemend {

/// Sums over windows, given as vectors of n numbers.
class WindowMoments {
 public:
  explicit WindowMoments(Eigen::Index size);

  /// One window per column.
  void add(const Eigen::MatrixXd& windows, double weight = 1);
  void add(const WindowMoments& other);

  double weight() const noexcept { return weight_; }
  Eigen::VectorXd mean() const { return sum_ / weight_; }
  /// n x n: mean of (x - centre) (x - centre)^T.
  Eigen::MatrixXd about(const Eigen::VectorXd& centre) const;
  Eigen::MatrixXd covariance() const { return about(mean()); }

 private:
  double weight_ = 0;
  Eigen::VectorXd sum_;
  Eigen::MatrixXd squares_;  // lower half
};

/// Principal directions of windows: orthonormal columns, variances descending.
struct Directions {
  Eigen::MatrixXd vectors;    ///< n x R
  Eigen::VectorXd variances;  ///< R
};
Directions leading_directions(const Eigen::MatrixXd& covariance, Eigen::Index rank);

/// n: cross-validated residual: mean square of one half of the windows outside the leading
/// directions of the other half, about the other's mean; averaged over both halves, which are not
/// empty. The residual of the training windows is biased low.
Eigen::VectorXd cross_validated_rest(const WindowMoments& half, const WindowMoments& other_half,
                                     Eigen::Index rank);

}  // namespace kinemend
