// The entries of the classical filters in the table of methods. Each file of a filter defines its
// own.
#pragma once

#include "kinemend/cleaner.hpp"

namespace kinemend {

Method bilateral_method();
Method butterworth_method();
Method gaussian_method();
Method hampel_method();
Method kalman_method();
Method median_method();
Method nonlocal_method();
Method one_euro_method();
Method wavelet_method();
Method weighted_mean_method();

}  // namespace kinemend
