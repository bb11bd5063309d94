// The inner loop of the bank of smoothers.
#pragma once

#include <cstddef>
#include <span>

namespace kinemend {

/// Rows of `width` numbers follow each other around `middle`. Writes taps[0] middle + the sum over
/// k of taps[k] (row k before + row k after). Every processor gives the same numbers.
void sum_rows(const float* middle, std::size_t width, std::span<const float> taps, float* result);

}  // namespace kinemend
