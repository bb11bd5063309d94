// Runs the network of the learned cleaner over a take.
#pragma once

#include <vector>

#include "methods/learned/motion_network.hpp"

namespace kinemend {

struct MotionResult {
  std::vector<float> values;  ///< F x C, degrees
  /// F x C: the standard deviation of each value's remaining error, as the network expects it.
  std::vector<float> deviation;
};

/// The take after the network. Channels that do not move are unchanged. Memory beside the take's
/// does not grow with its length; blocks of steps run in parallel, and neither affects the result.
MotionResult filtered(const MotionNetwork& network, const MotionTake& take);

}  // namespace kinemend
