// What the uses of the networks of Mall et al. share.
#pragma once

#include "kinemend/experimental/model.hpp"
#include "learned/papers/filter_network.hpp"

namespace kinemend {

/// A network that fills gaps. Errors: `ErrorKind::usage` for a model of the method that cleans.
FilterNetwork gap_network_of(const Model& model);

/// Whether two models see the same channels of the same body.
bool are_same(const BodyLayout& one, const BodyLayout& other);

/// Whether takes of this rate are the network's, whose filters are so many frames long.
bool has_rate_of(const FilterNetwork& network, double frame_rate_hz);

}  // namespace kinemend
