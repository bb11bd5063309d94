// Runs the method `learned` on a stream of frames.
#pragma once

#include <memory>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/representation.hpp"
#include "methods/learned/motion_network.hpp"

namespace kinemend {

/// The method `learned` on streams of takes like this one. `network`, a `live_form`, and `layout`
/// must outlive the filter. A skeleton is matched by its names. Joints that the model does not
/// know, or whose poses are unlike those it has learned, and markers are cleaned by their own
/// motion. The source of `like` decides whether slow noise is expected. Errors: as of `match_body`
/// for mapped names that do not match.
std::unique_ptr<LiveFilter> make_learned_live(const MotionNetwork& network,
                                              const BodyLayout& layout, const NameMap& names,
                                              const TakeView& like);

}  // namespace kinemend
