#pragma once

#include <Eigen/Core>
#include <vector>

#include "priors/wiener_prior.hpp"

namespace kinemend {

/// The posterior of z given windows with the same precision J (R x R) and their information
/// h = basis^T u (R x W, one column per window): of component c
///
///     P_c = (C_c^-1 + J)^-1,    z_c = P_c (C_c^-1 m_c + h),
///     log p(y | c) = 1/2 (log |P_c| - log |C_c| - m_c^T C_c^-1 m_c + b^T P_c b) + the same for all
///
/// with b = C_c^-1 m_c + h. Components are weighted by that evidence.
struct MixturePosterior {
  Eigen::MatrixXd shares;                    ///< C x W, columns sum to 1
  std::vector<Eigen::MatrixXd> means;        ///< C of R x W
  std::vector<Eigen::MatrixXd> covariances;  ///< C of R x R

  /// R x W: the posterior mean of the mixture.
  Eigen::MatrixXd mean() const;
};
MixturePosterior mixture_posterior(const std::vector<WienerPrior::Component>& components,
                                   const Eigen::MatrixXd& precision,
                                   const Eigen::MatrixXd& information);

/// Posterior moments of z for each component, summed over windows.
class MixtureMoments {
 public:
  MixtureMoments(std::size_t components, Eigen::Index rank);
  /// `weight` of a window, below 1 where windows overlap.
  void add(const MixturePosterior& posterior, double weight);
  /// Maximum a posteriori of the components, with the given ones as conjugate prior (normal and
  /// inverse Wishart): its mean has the weight of `mean_windows` windows, its covariance of
  /// `covariance_windows`. A component without windows is not changed.
  std::vector<WienerPrior::Component> adapted(const std::vector<WienerPrior::Component>& prior,
                                              double mean_windows, double covariance_windows) const;

 private:
  Eigen::VectorXd counts_;
  std::vector<Eigen::VectorXd> sums_;
  std::vector<Eigen::MatrixXd> squares_;
};

}  // namespace kinemend
