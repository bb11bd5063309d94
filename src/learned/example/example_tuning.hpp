// The parts and constants of `example`, so that each part can be left out and each constant moved
// to see what it brings. Only the experiment that does so sets them
// (`bench/papers/example_ablation.cpp`).
#pragma once

#include <memory>

#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

struct ExampleTuning {
  /// p, in deviations of the noise and in those of what the bases leave.
  double welsch_deviations = 3;
  double rest_deviations = 1;
  /// What the bases leave lasts: it says something new in one frame of so many.
  double rest_memory_frames = 3;
  bool guesses_suspects = true;    ///< starts from what `auto` made of spikes
  bool starts_expressible = true;  ///< starts from what the bases express of that
  bool knows_variances = true;     ///< v_k: the spread of the coefficients in training
  bool smooths_rest = true;        ///< keeps smooth motion outside of the bases
  bool leaves_strange = true;      ///< a strange take to `auto`
  bool leaves_biased = true;       ///< where the result is biased to `auto`
};

/// Errors: as of `make_example`.
std::unique_ptr<Cleaner> make_tuned_example(const ExampleOptions& options,
                                            std::shared_ptr<const Model> model,
                                            const ExampleTuning& tuning);

}  // namespace kinemend
