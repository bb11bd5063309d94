// Switches off the additions of `sparse` to the paper's method, to measure the effect of each. Only
// the experiments set these switches (`lab/experiments/xiao_ablation.cpp`).
#pragma once

#include <memory>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"

namespace kinemend {

struct SparseTuning {
  bool levels_markers = true;  ///< weighs all markers alike; off: by the noise of each
  bool guides_again = true;    ///< a second pass where many samples are outliers
  bool caps_noise = true;      ///< limits the noise to the scatter about the result
  bool smooths_rest = true;    ///< keeps smooth motion of markers that the atoms cannot express
  bool leaves_biased = true;   ///< takes `auto`'s result for parts where the result is biased
  bool holds = true;           ///< changes a part no further than its noise justifies
  bool marks_impulses = true;  ///< lifts that limit at outliers that `auto` has not seen
  bool averages = true;        ///< averages with `auto` where the atoms miss much
};

/// Errors: as of `make_sparse`.
std::unique_ptr<Cleaner> make_tuned_sparse(const SparseOptions& options,
                                           std::shared_ptr<const Model> model,
                                           const SparseTuning& tuning);

}  // namespace kinemend
