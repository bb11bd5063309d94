#pragma once

#include <cstddef>

#include "kinemend/fill.hpp"

namespace kinemend::fill {

/// Whether a gap of a clip that begins with frame `first` of the take is one that may be filled.
inline bool lies_within(const Gap& gap, std::size_t first, const FillSettings& settings) {
  return !settings.range || (gap.first_frame + first >= settings.range->first &&
                             gap.last_frame + first <= settings.range->second);
}

}  // namespace kinemend::fill
