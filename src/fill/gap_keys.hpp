// What tells a gap of a take from the others.
#pragma once

#include <cstddef>
#include <tuple>

#include "kinemend/clip.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend::fill {

constexpr bool is_joints(const Clip& /*clip*/) { return true; }
constexpr bool is_joints(const MarkerClip& /*clip*/) { return false; }

/// What tells a gap of a take from its others.
using GapKey = std::tuple<std::size_t, bool, std::size_t, std::size_t>;
inline GapKey key_of(const Gap& gap, bool is_position) {
  return {gap.track, is_position, gap.first_frame, gap.last_frame};
}

}  // namespace kinemend::fill
