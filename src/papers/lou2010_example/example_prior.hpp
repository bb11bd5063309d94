// The model of the method `example`, its tensors in a file, and the weights that follow from it.
#pragma once

#include <span>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "papers/lou2010_example/example_filter.hpp"
#include "papers/lou2010_example/mssa.hpp"
#include "papers/lou2010_example/window_bases.hpp"

namespace kinemend {

/// Model of the method `example`.
struct ExamplePrior {
  FilterBases bases;
  double rate_hz = 30;
  std::vector<double> lowest, highest;  ///< L: 0.1 % and 99.9 % quantiles of the channels
};

/// Tensors `bases` (M x L x K), `eigenvalues` (K), `mean`, `residual` (L) and `limits` (L x 2);
/// the number `energy`.
void store_example(const ExamplePrior& prior, Model& model);
/// Errors: `ErrorKind::unreadable_input` as of `Model::tensor`, and for eigenvalues or residuals
/// that are not valid variances.
ExamplePrior example_of(const Model& model);

/// Weights whose minimum is the most probable motion, for noise of standard deviation `noise` in
/// each channel (L, degrees; > 0), coefficients distributed as in the training and Gaussian motion
/// outside the bases with the residual variances. Each of these enters once, although windows
/// overlap. p is `welsch_deviations` times the noise.
ExampleWeights probable_weights(const ExamplePrior& prior, const WindowBases& bases,
                                std::span<const double> noise, double welsch_deviations);

}  // namespace kinemend
