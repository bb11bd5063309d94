#pragma once

#include "priors/motion/motion_steps.hpp"

namespace kinemend {

/// Puts beside the values of a take what the core of `auto` makes of them, which measures the noise
/// of each track and smooths as much as that asks (`MotionTake::measured`). Spikes stay.
void add_measured_smoothing(MotionTake& take);

}  // namespace kinemend
