// Fills gaps of joints by a network of Mall et al. (EBD).
#pragma once

#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend {

/// Poses (F x D) with the joints' unobserved samples filled by an EBD: straight lines over the
/// gaps, plus the network's additions. The additions at the ends of a gap are subtracted again,
/// decaying over a tenth of a second, so that the fill meets the measurements. The network runs at
/// its own rate. The root, the place and joints that were never seen keep straight lines. Observed
/// samples keep their values.
PoseMatrix filled_by_network(const FilterNetwork& network, const BodyLayout& layout,
                             const BodyChannels& channels);

}  // namespace kinemend
