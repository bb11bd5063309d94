// The posterior of the mixture for windows with the same noise and the same missing samples.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "methods/wiener/wiener_prior.hpp"

namespace kinemend {

/// The posterior of z given windows with the same precision J (R x R) and their information
/// h = basis^T u (R x W, one column per window): for component c
///
///     P_c = (C_c^-1 + J)^-1,    z_c = P_c (C_c^-1 m_c + h),
///     log p(y | c) = 1/2 (log |P_c| - log |C_c| - m_c^T C_c^-1 m_c + b^T P_c b) + the same for all
///
/// with b = C_c^-1 m_c + h. Components are weighted by that evidence.
struct MixturePosterior {
  Eigen::MatrixXd shares;              ///< C x W, columns sum to 1
  std::vector<Eigen::MatrixXd> means;  ///< C of R x W

  /// The posterior mean of the mixture, R x W.
  Eigen::MatrixXd mean() const;
};
MixturePosterior mixture_posterior(const std::vector<WienerPrior::Component>& components,
                                   const Eigen::MatrixXd& precision,
                                   const Eigen::MatrixXd& information);

}  // namespace kinemend
