#pragma once

#include "kinemend/cleaner.hpp"

namespace kinemend {

/// A take by a cleaner's live form, frame by frame: hands over the tracks that may change and do.
CleanTrace clean_as_live(const Cleaner& cleaner, const TakeView& take, const TrackSink& sink,
                         const std::function<void(double)>& tell);

}  // namespace kinemend
