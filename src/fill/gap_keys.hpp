// What tells a gap of a take from the others.
#pragma once

#include <cstddef>
#include <tuple>

#include "kinemend/gaps.hpp"

namespace kinemend::fill {

/// What tells a gap of a take from its others.
using GapKey = std::tuple<std::size_t, bool, std::size_t, std::size_t>;
inline GapKey key_of(const Gap& gap, bool is_position) {
  return {gap.track, is_position, gap.first_frame, gap.last_frame};
}

}  // namespace kinemend::fill
