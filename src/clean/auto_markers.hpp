#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/marker_clip.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

/// A degree stands for a 1150th of the stature (1.5 mm): optical systems see finer than angles are
/// measured.
inline constexpr double degrees_per_height = 1150;

/// The method `auto` on markers.
MarkerTrace clean_markers_by_evidence(MarkerClip& clip, const MarkerSelection& selection,
                                      const AutoOptions& options);

/// Of each of `markers` up to four others of them that keep their distance to it, nearest first:
/// within 0.3 statures, and usually to a 50th of a stature, in at most 50 frames.
std::vector<std::vector<std::size_t>> rigid_neighbours(const MarkerClip& clip,
                                                       const std::vector<std::size_t>& markers,
                                                       double body_height);

}  // namespace kinemend
