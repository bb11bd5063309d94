// Checks that the users of the networks of Mall et al. share.
#pragma once

#include "kinemend/experimental/model.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend {

/// Reads a network that fills gaps. Errors: `ErrorKind::usage` for a model of the cleaning method.
FilterNetwork gap_network_of(const Model& model);

/// Whether two models have the same channels of the same body.
bool are_same(const BodyLayout& one, const BodyLayout& other);

/// Whether a take's rate is that of the network, whose filters have fixed lengths in frames.
bool has_rate_of(const FilterNetwork& network, double frame_rate_hz);

}  // namespace kinemend
