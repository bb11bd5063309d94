// The parts and constants of `example`, so that each part can be left out and each constant varied
// to measure its effect. Only the experiment that does so sets them
// (`lab/experiments/example_ablation.cpp`).
#pragma once

#include <memory>

#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

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
