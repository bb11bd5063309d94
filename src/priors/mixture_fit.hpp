#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "priors/wiener_prior.hpp"

namespace kinemend {

struct MixtureSettings {
  std::size_t components = 8;  ///< at most; fewer where there are too few points
  std::size_t rounds = 10;
  double pooling = 300;  ///< weight of the pooled covariance in each component, in points
  std::uint64_t seed = 1;
};

/// A mixture of Gaussians fitted to the columns of `points` (R x W, W >= 1) by k-means on the
/// leading 30 rows and then expectation maximisation. The covariance of a component is shrunk
/// towards the pooled one, scaled to the component's variance, so that few points in many
/// dimensions suffice.
std::vector<WienerPrior::Component> fit_mixture(const Eigen::MatrixXd& points,
                                                const MixtureSettings& settings);

}  // namespace kinemend
