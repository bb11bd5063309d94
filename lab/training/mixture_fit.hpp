// Fits a mixture of Gaussians to points in many dimensions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "methods/wiener/wiener_prior.hpp"

namespace kinemend {

struct MixtureSettings {
  std::size_t components = 8;  ///< at most; fewer where there are too few points
  std::size_t rounds = 10;
  double pooling = 300;  ///< weight of the pooled covariance in each component, in points
  std::uint64_t seed = 1;
};

/// The state of the expectation maximisation.
struct MixtureState {
  std::size_t rounds = 0;  ///< done; 0: after k-means
  std::vector<WienerPrior::Component> components;
};

/// A mixture of Gaussians fitted to the columns of `points` (R x W, W >= 1) by k-means on the
/// leading 30 rows and then expectation maximisation. The covariance of a component is shrunk
/// towards the pooled one, scaled to the component's variance, so that few points in many
/// dimensions suffice. `after_each` sees the state after each round. Given such a state as `start`,
/// of the same points and settings, the fit resumes there with an identical result.
std::vector<WienerPrior::Component> fit_mixture(
    const Eigen::MatrixXd& points, const MixtureSettings& settings,
    const std::function<void(const MixtureState&)>& after_each = {},
    const MixtureState* start = nullptr);

}  // namespace kinemend
