// Fills gaps of joints by a network of Mall et al. (EBD).
#pragma once

#include "learned/papers/filter_network.hpp"

namespace kinemend {

/// Poses (F x D) in which an EBD has filled the joints' samples that are not observed: straight
/// lines over the gaps, and what the network adds to them. What it would add at the ends of a gap
/// is taken off again, over a tenth of a second, so that the filling meets what was measured. The
/// network sees the take at its own rate; the root, the place and joints that were never seen stay
/// straight lines. Observed samples keep their values.
PoseMatrix filled_by_network(const FilterNetwork& network, const BodyLayout& layout,
                             const BodyChannels& channels);

}  // namespace kinemend
