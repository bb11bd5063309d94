// Runs the method `learned` on a stream of frames.
#pragma once

#include <memory>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/representation.hpp"
#include "learned/corrector/motion_network.hpp"

namespace kinemend {

/// The method `learned` on streams of takes like this one. `network`, a `live_form`, and `layout`
/// outlive the filter. A skeleton is matched by its names; joints that the model does not know, or
/// whose poses are not of the kind that it has learned, and markers are cleaned by what they do
/// themselves. The source of `like` decides what becomes of slow noise. Errors: as of `match_body`
/// for names that are mapped and do not fit.
std::unique_ptr<LiveFilter> make_learned_live(const MotionNetwork& network,
                                              const BodyLayout& layout, const NameMap& names,
                                              const TakeView& like);

}  // namespace kinemend
