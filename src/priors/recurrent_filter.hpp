#pragma once

#include <cstdint>
#include <span>

#include "kinemend/pose_matrix.hpp"
#include "priors/recurrent_network.hpp"

namespace kinemend {

/// A take in the channels of the network's body, before and after `auto`.
struct RecurrentFacts {
  const PoseMatrix& measured;             ///< F x D, y; nothing is read where `missing`
  const PoseMatrix& automatic;            ///< F x D, a
  std::span<const std::uint8_t> missing;  ///< F x D, 1: not measured, or a spike
  double rate_hz = 120;
};

/// What the network makes of it: a plus a correction, which is found at the network's rate and
/// brought to the take's by straight lines. Long takes are done in overlapping stretches, so that
/// memory is bounded.
PoseMatrix recurrent_filter(const RecurrentNetwork& network, const RecurrentFacts& facts);

}  // namespace kinemend
