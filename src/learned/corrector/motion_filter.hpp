// Runs the network of the learned cleaner over a take.
#pragma once

#include <vector>

#include "learned/corrector/motion_network.hpp"

namespace kinemend {

struct MotionResult {
  std::vector<float> values;  ///< F x C, degrees
  /// F x C: the standard deviation of what will be wrong with each, as the network expects it.
  std::vector<float> deviation;
};

/// What the network makes of a take. Channels that do not move stay. Memory beside the take's does
/// not grow with its length; blocks of steps go in parallel, and the result depends on neither.
MotionResult filtered(const MotionNetwork& network, const MotionTake& take);

}  // namespace kinemend
