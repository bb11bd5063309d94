// Adds the result of `auto`'s measured noise to the learned cleaner.
#pragma once

#include "methods/learned/motion_filter.hpp"
#include "methods/learned/motion_steps.hpp"

namespace kinemend {

/// Sets `MotionTake::measured` to the take after the core of `auto`, which measures the noise of
/// each track and smooths by it. Spikes remain.
void add_measured_smoothing(MotionTake& take);

/// Moves each track of a result towards `MotionTake::measured`: averaging two estimates with
/// different errors is better than either. The share of `measured` is a / (a + r), where a and r
/// are the energies that `measured` and the result remove, times the square of the share of a that
/// changes within a 25th of a second: only quick noise can be measured from a take itself. Tracks
/// without measured noise are unchanged.
void join_measured(const MotionTake& take, MotionResult& result);

}  // namespace kinemend
