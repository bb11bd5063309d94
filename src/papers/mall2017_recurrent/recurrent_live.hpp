// Runs the filter networks of Mall et al. on a stream of frames.
#pragma once

#include <memory>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend {

/// A filter network of a model on takes like this one, at its own rate. Known joints are filtered;
/// the root, positions, and unknown joints are passed through. The skeleton is matched by its rest
/// pose. `network` and its model must outlive the filter. Errors: `ErrorKind::usage` for markers,
/// another rate, a network without a filter, and as of `match_body`.
std::unique_ptr<LiveFilter> make_recurrent_live(const FilterNetwork& network,
                                                const BodyLayout& layout, const NameMap& names,
                                                const TakeView& like);

}  // namespace kinemend
