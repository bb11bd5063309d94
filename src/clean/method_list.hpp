#pragma once

#include "kinemend/cleaner.hpp"
#include "priors/learned_list.hpp"

// Each cleaner's file defines its entry in the table of methods; `methods.cpp` lists them. Those
// of methods with a learned model stand in `learned_list.hpp`.
namespace kinemend {

Method auto_method();
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

#define KINEMEND_DECLARE(name) Method name##_method();
KINEMEND_LEARNED_METHODS(KINEMEND_DECLARE)
KINEMEND_NETWORK_METHODS(KINEMEND_DECLARE)
#undef KINEMEND_DECLARE

}  // namespace kinemend
