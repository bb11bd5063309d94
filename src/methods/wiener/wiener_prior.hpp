// The prior of the method `wiener`: the distribution of short windows of motion.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "kinemend/extend/model.hpp"

namespace kinemend {

/// Windows of `window_s` of D channels as DCT coefficients (`window_cosines`), channel-major: entry
/// d K + k is coefficient k of channel d. A window is
///
///     x = mean + basis z + e,    z ~ sum_c weight_c N(mean_c, covariance_c)
///
/// and e are independent normal numbers of variance `rest`, which also holds the variance of the
/// coefficients beyond the basis (k >= K), those of quick motion. Units: degrees, and their
/// squares.
struct WienerPrior {
  struct Component {
    double weight = 1;
    Eigen::VectorXd mean;        ///< R
    Eigen::MatrixXd covariance;  ///< R x R
  };
  double window_s = 0.5;
  Eigen::VectorXd mean;   ///< D K
  Eigen::MatrixXd basis;  ///< D K x R, orthonormal columns
  Eigen::MatrixXd rest;   ///< D x M, M >= K: variance outside the basis
  std::vector<Component> components;

  Eigen::Index channels() const { return rest.rows(); }
  Eigen::Index coefficients() const { return rest.rows() == 0 ? 0 : mean.size() / rest.rows(); }
  Eigen::Index rank() const { return basis.cols(); }
};

/// The prior of windows at another rate, where a window may have fewer frames than the prior has
/// coefficients: the high ones are left out.
WienerPrior with_coefficients(const WienerPrior& prior, Eigen::Index coefficients);

/// The prior of rotated channels, x' = turn x with one rotation for each three. The rest is again
/// taken as independent.
WienerPrior with_turned_channels(const WienerPrior& prior, std::span<const Eigen::Matrix3d> turns);

/// Convert to and from tensors of the model file. Covariances are stored as Cholesky factors, large
/// tensors in 16 bits. Errors: `ErrorKind::unreadable_input` naming the inconsistent tensor.
void store_wiener_prior(const WienerPrior& prior, Model& model);
WienerPrior wiener_prior_of(const Model& model);

}  // namespace kinemend
