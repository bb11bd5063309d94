// Describes the model of the method `example`, its tensors in a file, and the weights that follow
// from it. Parts can be left out and constants varied to measure their effect; only the experiment
// that does so sets them (`lab/experiments/example_ablation.cpp`).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "papers/lou2010_example/example_filter.hpp"
#include "papers/lou2010_example/filter_bases.hpp"

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

struct ExampleTuning {
  /// p, in deviations of the noise and of the residual outside the bases.
  double welsch_deviations = 3;
  double rest_deviations = 1;
  /// Motion outside the bases is correlated: one frame in this number is independent.
  double rest_memory_frames = 3;
  bool guesses_suspects = true;    ///< starts from `auto`'s values at spikes
  bool starts_expressible = true;  ///< starts from the part of that which the bases express
  bool knows_variances = true;     ///< v_k: the spread of the coefficients in training
  bool smooths_rest = true;        ///< keeps smooth motion outside the bases
  bool leaves_strange = true;      ///< leaves a strange take to `auto`
  bool leaves_biased = true;       ///< leaves parts with a biased result to `auto`
};

/// Errors: as of `make_example`.
std::unique_ptr<Cleaner> make_tuned_example(const ExampleOptions& options,
                                            std::shared_ptr<const Model> model,
                                            const ExampleTuning& tuning);

}  // namespace kinemend
