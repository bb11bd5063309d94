// Adds to the learned cleaner what `auto` makes of a take by the noise that it measures.
#pragma once

#include "learned/corrector/motion_filter.hpp"
#include "learned/corrector/motion_steps.hpp"

namespace kinemend {

/// Puts beside the values of a take what the core of `auto` makes of them, which measures the noise
/// of each track and smooths as much as that asks (`MotionTake::measured`). Spikes stay.
void add_measured_smoothing(MotionTake& take);

/// Brings each track of a result nearer to `MotionTake::measured`: two estimates that err unlike
/// are better together. The share is that of `measured` in what both take out, a / (a + r) of their
/// energies, times the square of how much of a changes within a 25th of a second: only quick noise
/// is something that a take shows by itself. Tracks in which nothing was measured stay.
void join_measured(const MotionTake& take, MotionResult& result);

}  // namespace kinemend
