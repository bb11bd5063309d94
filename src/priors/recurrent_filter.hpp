#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
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

/// The same with only so much of the correction of each track (0 to 1) as helps in a trial: what
/// `auto` made of the take is taken for the truth, what it took away is added again, backwards in
/// time, and `auto` and the network clean that. A body or a motion that is unlike all that was
/// learned from keeps what `auto` made of it; so do the place of the body, takes below 45 Hz, and
/// frames that are samples of a lower rate. `shares`, if any, receives these (D / 3).
PoseMatrix guarded_recurrent_filter(const RecurrentNetwork& network, const BodyLayout& layout,
                                    const RecurrentFacts& facts,
                                    std::vector<double>* shares = nullptr);

}  // namespace kinemend
