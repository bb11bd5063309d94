// Converts outputs of the network to weights of levels, corrections and expected errors.
#pragma once

#include <span>
#include <vector>

#include "methods/learned/motion_steps.hpp"

namespace kinemend {

/// For every channel and step: the weights of the levels (C x steps x `motion_levels`), the
/// correction and the deviation.
struct MotionMixes {
  std::vector<float> levels, corrections, deviations;
};

/// Converts outputs of the network (C x steps x `motion_outputs`, overwritten). Does not allocate
/// if `mixes` held as many before.
void mix(std::span<float> outputs, const MotionSteps& steps, MotionMixes& mixes);

}  // namespace kinemend
