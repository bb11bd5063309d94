// The entries of the classical filters in the table of methods. Each file of a filter defines its
// own.
#pragma once

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"

namespace kinemend {

Method butterworth_method();
Method gaussian_method();
Method hampel_method();
Method kalman_method();
inline constexpr ModelKind kalman_learned_models{"kalman-learned", 1, "kinemend train"};
Method kalman_learned_method();
Method median_method();
Method one_euro_method();
Method wavelet_method();
Method weighted_mean_method();

}  // namespace kinemend
