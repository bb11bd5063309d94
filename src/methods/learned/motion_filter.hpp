// Runs the network of the learned cleaner over a take, converts its outputs to weights, corrections
// and expected errors, and joins the result with that of `auto`'s measured noise.
#pragma once

#include <span>
#include <vector>

#include "methods/learned/motion_network.hpp"
#include "methods/learned/motion_steps.hpp"

namespace kinemend {

struct MotionResult {
  std::vector<float> values;  ///< F x C, degrees
  /// F x C: the standard deviation of each value's remaining error, as the network expects it.
  std::vector<float> deviation;
};

/// The take after the network. Channels that do not move are unchanged. Memory beside the take's
/// does not grow with its length; blocks of steps run in parallel, and neither affects the result.
MotionResult filtered(const MotionNetwork& network, const MotionTake& take);

/// For every channel and step: the weights of the levels (C x steps x `motion_levels`), the
/// correction and the deviation.
struct MotionMixes {
  std::vector<float> levels, corrections, deviations;
};

/// Converts outputs of the network (C x steps x `motion_outputs`, overwritten). Does not allocate
/// if `mixes` held as many before.
void mix(std::span<float> outputs, const MotionSteps& steps, MotionMixes& mixes);

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
