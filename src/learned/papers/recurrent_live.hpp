// Runs the filter networks of Mall et al. on a stream of frames.
#pragma once

#include <memory>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"
#include "learned/papers/filter_network.hpp"

namespace kinemend {

/// A filter network of a model on takes like this one, at its own rate. Joints that the model knows
/// come out filtered; the root, positions, and joints that it does not know come out as they were
/// measured. The skeleton is matched by its rest pose. `network` and `model` outlive the filter.
/// Errors: `ErrorKind::usage` for markers, another rate, a network that filters nothing, and as of
/// `match_body`.
std::unique_ptr<LiveFilter> make_recurrent_live(const FilterNetwork& network,
                                                const BodyLayout& layout, const NameMap& names,
                                                const TakeView& like);

}  // namespace kinemend
