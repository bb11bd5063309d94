#pragma once

#include "kinemend/cleaner.hpp"

// Each cleaner's file defines its entry in the table of methods; `methods.cpp` lists them.
namespace kinemend {

Method auto_method();
Method bilateral_method();
Method butterworth_method();
Method example_method();
Method gaussian_method();
Method hampel_method();
Method kalman_learned_method();
Method kalman_method();
Method median_method();
Method nonlocal_method();
Method one_euro_method();
Method wavelet_method();
Method weighted_mean_method();
Method wiener_method();

}  // namespace kinemend
